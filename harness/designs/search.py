"""Optimisation: how better designs are found, always the same (differential evolution, TPE; Nelder-Mead, SLSQP)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import UsageError, way_to_get
from ..fmu.description import Value
from .landscape import Landscape, NoGradientError
from .optimum_file import CONTINUOUS, Optimum
from .store import Store
from .task import Design, Result
from .variation import Axis
from .workers import Executor

# The designs of a search, in the order in which it asks for them; what is there already is not run again.

#: A search that asks so often in a row for what it has had will not come to anything new.
_MOST_IDLE = 50

#: Of a design, in the order of the variables.
_Values = tuple[Value, ...]


class EnoughError(Exception):
    """The search has had all designs that it may have."""


class InterruptedSearchError(Exception):
    """Somebody wants it to end; what there is, is kept."""


class History:
    """All designs that a search has asked for.

    A search that is the same each time asks for the same designs in the same order. So one that was interrupted begins
    anew and is answered from the disk until it comes to what is not there.

    Attributes:
        designs: asked for so far, in this run of the command.
        results: theirs.
        limit: how many may be asked for.
        earlier: how many were on the disk when it began.
    """

    def __init__(
        self,
        store: Store,
        executor: Executor,
        limit: int,
        stop_requested: Callable[[], bool],
        on_progress: Callable[[History], None],
    ) -> None:
        """Begin, with what a store has of earlier runs."""
        self.designs: list[Design] = []
        self.results: list[Result] = []
        self._seen: dict[_Values, Result] = {}
        self.allow(limit)
        self._kept = store.pairs()
        self.earlier = len(self._kept)
        self._store, self._executor = store, executor
        self._stop_requested, self._on_progress = stop_requested, on_progress

    def allow(self, limit: int) -> None:
        """Begin a part of the search, which may go on to so many designs in all."""
        self.limit = limit
        self._idle = 0

    def results_of(self, candidates: Sequence[Mapping[str, Value]]) -> list[Result]:
        """Results of designs, in their order; those behind the first that exceeds the limit are left out.

        Values that were asked for before are answered from memory and count no second time.

        Raises:
            EnoughError: not a single one is left within the limit, or the search has nothing new to ask for.
            InterruptedSearchError: somebody wants it to end.
            UsageError: what is kept belongs to another search, or the disk refuses.
        """
        new: dict[_Values, Design] = {}
        wanted: list[_Values] = []
        for candidate in candidates:
            values = tuple(candidate.values())
            if values not in self._seen and values not in new:
                if len(self.designs) + len(new) == self.limit:
                    break
                new[values] = Design(len(self.designs) + len(new) + 1, dict(candidate))
            wanted.append(values)
        self._idle = 0 if new else self._idle + 1
        if not wanted or self._idle > _MOST_IDLE:
            raise EnoughError
        self._run(list(new.values()))
        return [self._seen[values] for values in wanted]

    def _run(self, designs: Sequence[Design]) -> None:
        """Find the results of designs, on the disk or by running them."""
        found = {design.number: self._known(design) for design in designs if design.number in self._kept}
        missing = [design for design in designs if design.number not in found]
        for pairs in self._executor(missing, self._stop_requested) if missing else ():
            self._store.append(pairs)
            found |= {design.number: result for design, result in pairs}
        if len(found) < len(designs):
            raise InterruptedSearchError
        for design in designs:
            self.designs.append(design)
            self.results.append(found[design.number])
            self._seen[tuple(design.values.values())] = found[design.number]
        self._on_progress(self)

    def _known(self, design: Design) -> Result:
        values, result = self._kept[design.number]
        if values != design.values:
            raise UsageError(
                f"Design {design.number} in '{self._store.folder}' has other values than the search asks for now: it "
                f"was found with other versions of scipy or optuna. Choose another folder with -o."
            )
        return result


# How better designs are found. Every search asks for the same designs each time.

#: Members of a generation for each variable.
_MEMBERS = 8
#: Candidates that are run before the next are thought of. Not the number of processors: it would decide what is found.
_TOGETHER = 8
#: Part of all designs that the search at large may have; the rest refines what it found, along gradients half of all.
_AT_LARGE, _BEFORE_GRADIENTS = 0.75, 0.5
#: First and last size of the simplex that refines, as a part of each range.
_FIRST, _LAST = 0.05, 1e-7
#: Along gradients it ends where the objective gets better by less than this part of its size at the beginning.
_FINE = 1e-9


@dataclass(frozen=True)
class Best:
    """The best design of a search.

    Attributes:
        design: it is.
        result: of it.
        feasible: whether it keeps all limits.
    """

    design: Design
    result: Result
    feasible: bool


def search(optimum: Optimum, history: History) -> Best:
    """Look for the best design.

    Raises:
        UsageError: a library is missing, or the disk refuses.
        InterruptedSearchError: somebody wants it to end.
    """
    real = [axis for axis in optimum.axes if axis.values is None and axis.variable.type == "Real"]
    part = _BEFORE_GRADIENTS if optimum.gradient else _AT_LARGE
    at_large = max(1, round(part * optimum.count)) if real else optimum.count
    history.allow(at_large)
    _until_enough(
        lambda: _differential_evolution(optimum, history) if optimum.method == CONTINUOUS else _tpe(optimum, history)
    )
    history.allow(optimum.count)
    if real:
        _until_enough(lambda: _refine(optimum, history, real))
    return best_of(optimum, history)


def best_of(optimum: Optimum, history: History) -> Best:
    """The best design so far, of equally good ones the first."""
    merits = [optimum.goal.merit(result, optimum.task) for result in history.results]
    place = int(np.argmin(merits))
    result = history.results[place]
    return Best(history.designs[place], result, optimum.goal.violation(result, optimum.task) == 0.0)


def _refine(optimum: Optimum, history: History, real: Sequence[Axis]) -> None:
    """Along gradients, where they are asked for and there are any; else by comparing merits."""
    if not (optimum.gradient and _descend(optimum, history, real)):
        _nelder_mead(optimum, history, real)


def _until_enough(look: Callable[[], object]) -> None:
    try:
        look()
    except EnoughError:
        return


def _merits(optimum: Optimum, history: History, candidates: Sequence[dict[str, Value]]) -> npt.NDArray[np.float64]:
    """Merits of all candidates.

    Raises:
        EnoughError: some of them are more than there may be.
    """
    results = history.results_of(candidates)
    if len(results) < len(candidates):
        raise EnoughError
    return np.array([optimum.goal.merit(result, optimum.task) for result in results])


def _differential_evolution(optimum: Optimum, history: History) -> None:
    """R. Storn, K. Price, J. Global Optimization 11 (1997): it compares merits, and nothing else."""
    from scipy import optimize  # takes long to load

    def merits(fractions: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        return _merits(optimum, history, [_at(optimum.axes, point) for point in np.atleast_2d(fractions.T)])

    optimize.differential_evolution(
        merits,
        [(0.0, 1.0)] * len(optimum.axes),
        popsize=_MEMBERS,
        maxiter=optimum.count,
        rng=np.random.default_rng(optimum.seed),
        polish=False,
        updating="deferred",
        vectorized=True,
    )


def _nelder_mead(optimum: Optimum, history: History, real: Sequence[Axis]) -> None:
    """Refine the Real variables of the best design; it compares merits, and nothing else."""
    from scipy import optimize

    best = best_of(optimum, history).design.values
    start = np.array([axis.fraction(float(best[axis.name])) for axis in real])
    simplex = np.vstack([start, *(_moved(start, k) for k in range(len(real)))])

    def merit(fractions: npt.NDArray[np.float64]) -> float:
        return float(_merits(optimum, history, [dict(best) | _at(real, fractions)])[0])

    optimize.minimize(
        merit,
        start,
        method="Nelder-Mead",
        bounds=[(0.0, 1.0)] * len(real),
        options={"initial_simplex": simplex, "xatol": _LAST, "fatol": np.inf, "maxfev": 10 * optimum.count},
    )


def _descend(optimum: Optimum, history: History, real: Sequence[Axis]) -> bool:
    """Refine the Real variables of the best design by gradients; whether there were any, and it came to an end.

    D. Kraft, A software package for sequential quadratic programming, DFVLR-FB 88-28 (1988), by scipy.
    """
    from scipy import optimize

    start = best_of(optimum, history)
    if start.result.failure is not None:
        return False
    fractions = np.array([axis.fraction(float(start.design.values[axis.name])) for axis in real])
    try:
        landscape = Landscape(optimum, real, start.design.values, lambda points: _all_of(history, points))
        outcome = optimize.minimize(
            landscape.objective,
            fractions,
            method="SLSQP",
            jac=landscape.objective_slopes,
            bounds=[(0.0, 1.0)] * len(real),
            constraints=landscape.constraints(),
            options={"ftol": _FINE, "maxiter": optimum.count},
        )
    except NoGradientError:
        return False
    return bool(outcome.success)


def _all_of(history: History, points: Sequence[Mapping[str, Value]]) -> list[Result]:
    results = history.results_of(points)
    if len(results) < len(points):
        raise EnoughError
    return results


def _moved(start: npt.NDArray[np.float64], k: int) -> npt.NDArray[np.float64]:
    corner = start.copy()
    corner[k] += _FIRST if start[k] < 0.5 else -_FIRST
    return corner


def _tpe(optimum: Optimum, history: History) -> None:
    """J. Bergstra et al., NIPS 24 (2011), by optuna: for whole numbers and lists, too."""
    optuna = _optuna()
    ranges = {axis.name: _distribution(optuna, axis) for axis in optimum.axes}
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=optimum.seed))
    whole = math.prod(axis.count for axis in optimum.axes)
    while len(history.designs) < whole:
        trials = [study.ask(ranges) for _ in range(_TOGETHER)]
        candidates = [{axis.name: _chosen(axis, trial.params[axis.name]) for axis in optimum.axes} for trial in trials]
        results = history.results_of(candidates)
        for trial, result in zip(trials, results, strict=False):
            violation, value = (look(result, optimum.task) for look in (optimum.goal.violation, optimum.goal.value))
            if violation is None or value is None:
                study.tell(trial, state=optuna.trial.TrialState.FAIL)
            else:
                trial.set_constraint("violation", violation)
                study.tell(trial, -value if optimum.goal.largest else value)


def _optuna() -> Any:
    try:
        import optuna
    except ImportError:
        raise UsageError(
            f"Whole numbers and lists of values need optuna, which is not installed: {way_to_get('optimise')}"
        ) from None
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    return optuna


def _distribution(optuna: Any, axis: Axis) -> Any:
    if axis.values is not None:
        return optuna.distributions.CategoricalDistribution(range(len(axis.values)))
    if axis.variable.type == "Integer":
        return optuna.distributions.IntDistribution(int(axis.low), int(axis.high))
    return optuna.distributions.FloatDistribution(axis.low, axis.high)


def _chosen(axis: Axis, choice: Any) -> Value:
    if axis.values is not None:
        return axis.values[int(choice)]
    return int(choice) if axis.variable.type == "Integer" else axis.real(float(choice))


def _at(axes: Sequence[Axis], fractions: npt.NDArray[np.float64]) -> dict[str, Value]:
    return {axis.name: axis.at(float(x)) for axis, x in zip(axes, fractions, strict=True)}
