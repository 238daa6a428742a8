"""The lightest linkage within limits of deviation and stress: the search over parameters of its model."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from mechanism_fmu.elastodynamics import (
    Judgement,
    LinkageError,
    Synthesis,
    crank_of,
    judge_quasi_static,
    judge_steady_state,
    lightest,
    quasi_static,
    resized_members,
    turn,
)

from ...errors import UsageError
from ...fmu.description import Description, Value
from ...fmu.values import parse_value, settable_variable
from .judged_by import JudgedBy
from .options import Limits
from .solution import FloatArray, Solution

#: Steps of the turn at which designs are judged during the search; the result is calculated anew, finer.
_SAMPLES = 180
#: Bounds of a depth by default, in parts of its value.
_LEAST, _LARGEST = 0.25, 4.0
#: By this part a parameter is changed to see what it does.
_NUDGE = 1e-3
#: So often the search may go on with tighter limits, when the finer calculation finds more than it did.
_ROUNDS = 4
#: Beyond what the finer calculation finds too much, the limits are tightened by this part.
_MARGIN = 1e-5
#: To so many digits is a design rounded, as it is shown and written.
_DIGITS = 9
#: Judged designs after which the bar of progress is at two thirds.
_USUAL = 150

#: A mechanism for values of parameters.
Describe = Callable[[Mapping[str, Value]], Any]


@dataclass(frozen=True)
class Bounds:
    """A parameter that may change, from `least` to `largest` [its unit]."""

    name: str
    least: float
    largest: float


@dataclass(frozen=True)
class Synthesised:
    """The lightest design.

    Attributes:
        bounds: of the parameters that were varied.
        start, design: their values before and after, shape (parameters,).
        angle: of the crank, at which designs were judged, over a turn from the start on [rad], shape (times,).
        before, after: the designs as they were judged.
        evaluations: how many designs were judged.
        limits: that were asked for.
    """

    bounds: tuple[Bounds, ...]
    start: FloatArray
    design: FloatArray
    angle: FloatArray
    before: Judgement
    after: Judgement
    evaluations: int
    limits: Limits

    @property
    def values(self) -> dict[str, Value]:
        """The design by names of parameters."""
        return {bound.name: float(value) for bound, value in zip(self.bounds, self.design, strict=True)}


def bounds_of(vary: Sequence[str], describe: Describe, given: Mapping[str, Value], fmu: Description) -> list[Bounds]:
    """The parameters to be varied: those named, or those that change nothing but the depths of members.

    Args:
        vary: "NAME=LEAST..LARGEST", with units.
        describe: the mechanism for parameters.
        given: parameters that differ from the model's defaults.
        fmu: its description.

    Raises:
        UsageError: a parameter is not known, changes more than sections, or its bounds cannot be; or there is none.
    """
    if vary:
        found = [_understood(text, fmu) for text in vary]
        twice = {bound.name for bound in found if sum(other.name == bound.name for other in found) > 1}
        if twice:
            raise UsageError(f"'{min(twice)}' is varied twice; vary it once.")
        for bound in found:
            _require_sections_only(bound.name, describe, given, fmu)
        return found
    depths = [name for name in _numbers(fmu) if _depths_of(name, describe, given, fmu)]
    if not depths:
        raise UsageError(
            "No parameter of this model changes the depths of members and nothing else; name those that may change, "
            "e.g. --vary 'bar_depth=5..40 mm'."
        )
    now = {name: _at(name, given, fmu) for name in depths}
    return [_within(Bounds(name, _LEAST * at, _LARGEST * at), fmu) for name, at in now.items()]


def synthesised(
    bounds: Sequence[Bounds],
    describe: Describe,
    given: Mapping[str, Value],
    fmu: Description,
    place: str,
    speed: float,
    damping: float,
    limits: Limits,
    analyse: Callable[[Mapping[str, Value]], Solution],
    progress: Callable[[str, float], None],
) -> Synthesised:
    """The lightest design nearby, to nine digits; its turn, calculated anew by `analyse` in full, keeps to the limits.

    The search judges a turn at few angles. It begins where that by the quasi-static solution ends, which is quick, or
    with the design that is given, whichever is nearer to the limits. If the full calculation finds more deviation or
    stress than allowed, the search goes on from there with limits that are so much tighter.

    Raises:
        UsageError: there is none within the bounds; the message says how near the best came.
    """
    assert limits.deviation is not None
    assert limits.stress is not None
    names = [bound.name for bound in bounds]
    least, largest = (np.array([getattr(bound, end) for bound in bounds]) for end in ("least", "largest"))
    first = np.clip([_at(name, given, fmu) for name in names], least, largest)
    judged, angle = 0, np.zeros(0)

    def judge(design: FloatArray, by: JudgedBy = limits.judged_by) -> Judgement:
        nonlocal judged, angle
        mechanism = describe({**given, **dict(zip(names, map(float, design), strict=True))})
        cycle = quasi_static(turn(mechanism, speed, _SAMPLES))
        pose, static = cycle.configurations.pose, by is JudgedBy.QUASI_STATIC
        angle = pose.position[:, pose.bodies.index(crank_of(mechanism)), 2]
        found = judge_quasi_static(cycle, place) if static else judge_steady_state(cycle, place, damping)
        judged += 1
        stress, deviation = 1e-6 * float(found.stress.max()), 1e3 * float(found.deviation.max())
        text = f"Design {judged}: {found.mass:.4g} kg, {deviation:.4g} mm, {stress:.4g} MPa"
        progress(text, 1.0 - math.exp(-judged / _USUAL))
        return found

    def search(by: JudgedBy, begin: FloatArray, deviation: float, stress: float) -> Synthesis:
        return lightest(lambda design: judge(design, by), begin, least, largest, deviation, stress)

    allowed = np.array([limits.deviation, limits.stress])

    def excess(design: FloatArray) -> float:
        found = judge(design)
        return float((np.array([found.deviation.max(), found.stress.max()]) / allowed).max())

    tight = allowed
    with warnings.catch_warnings():
        # that few angles do for a search; what it finds is calculated anew
        warnings.filterwarnings("ignore", message=".*harmonics, all that")
        try:
            before = judge(first)
            starts = [first]
            if limits.judged_by is not JudgedBy.QUASI_STATIC:
                quick = _first_found([lambda: search(JudgedBy.QUASI_STATIC, first, *allowed.tolist())], first)
                starts = sorted([quick, first], key=excess)
            for _ in range(_ROUNDS):
                tries = [partial(search, limits.judged_by, start, *tight.tolist()) for start in starts]
                found = _first_found(tries)
                design = np.clip([float(f"{value:.{_DIGITS}g}") for value in found.tolist()], least, largest)
                bent = limits.of(analyse(dict(zip(names, map(float, design), strict=True))))
                over = np.array([bent.largest_deviation, bent.largest_stress.max()]) / allowed
                if over.max() <= 1.0:
                    break
                tight, starts = tight / np.where(over > 1.0, over * (1.0 + _MARGIN), 1.0), [design]
            after = judge(design)
        except (LinkageError, ValueError) as error:
            raise UsageError(f"{error} Varied were: {', '.join(names)}.") from error
    return Synthesised(tuple(bounds), first, design, angle, before, after, judged, limits)


def _first_found(tries: Sequence[Callable[[], Synthesis]], otherwise: FloatArray | None = None) -> FloatArray:
    """The design of the first search that finds one, or `otherwise`.

    Raises:
        LinkageError: none does, and there is nothing else; that of the last one.
    """
    for number, search in enumerate(tries, start=1):
        try:
            return search().design
        except LinkageError:
            if number == len(tries) and otherwise is None:
                raise
    assert otherwise is not None
    return otherwise


def _understood(text: str, fmu: Description) -> Bounds:
    """Bounds as the user writes them: "arm_depth=5..20 mm"; a lower one without a unit has that of the upper one."""
    name, equals, ends = text.partition("=")
    least, dots, largest = ends.partition("..")
    name = name.strip()
    if not equals or not dots:
        raise UsageError(f"--vary '{text}' is no range; write NAME=LEAST..LARGEST, e.g. 'arm_depth=5..20 mm'.")
    variable = settable_variable(name, fmu)
    if variable.type != "Real" or variable.causality != "parameter":
        raise UsageError(f"'{name}' is no real parameter, so it cannot be varied.")
    unit = re.sub(r"^[\s\d.eE+-]*", "", largest)
    if re.fullmatch(r"[\s\d.eE+-]+", least):
        least = f"{least.strip()} {unit}"
    low, high = (float(parse_value(end.strip(), variable, fmu)) for end in (least, largest))
    if not low < high:
        raise UsageError(f"--vary '{text}': the lower bound must be below the upper one.")
    return Bounds(name, low, high)


def _numbers(fmu: Description) -> list[str]:
    return [variable.name for variable in fmu.of("parameter") if variable.type == "Real"]


def _at(name: str, given: Mapping[str, Value], fmu: Description) -> float:
    return float(given.get(name, fmu.variable(name).start or 0.0))


def _within(bounds: Bounds, fmu: Description) -> Bounds:
    """Inside the limits of the parameter."""
    variable = fmu.variable(bounds.name)
    least = bounds.least if variable.minimum is None else max(bounds.least, variable.minimum)
    largest = bounds.largest if variable.maximum is None else min(bounds.largest, variable.maximum)
    return Bounds(bounds.name, least, largest)


def _resized(name: str, describe: Describe, given: Mapping[str, Value], fmu: Description) -> Any:
    """What of the mechanism a small change of a parameter changes."""
    at, most = _at(name, given, fmu), fmu.variable(name).maximum
    nudged = at * (1.0 + _NUDGE) if most is None or at * (1.0 + _NUDGE) <= most else at * (1.0 - _NUDGE)
    return None if at == nudged else resized_members(describe(given), describe({**given, name: nudged}))


def _depths_of(name: str, describe: Describe, given: Mapping[str, Value], fmu: Description) -> bool:
    found = _resized(name, describe, given, fmu)
    return found is not None and bool(found.depths)


def _require_sections_only(name: str, describe: Describe, given: Mapping[str, Value], fmu: Description) -> None:
    found = _resized(name, describe, given, fmu)
    if found is not None and found.members:
        return
    fit = [one for one in _numbers(fmu) if (sized := _resized(one, describe, given, fmu)) and sized.members]
    raise UsageError(
        f"'{name}' is no size of a section: --synthesise leaves the path, the material and all other masses as they "
        f"are. These can be varied: {', '.join(fit) or 'none'}."
    )
