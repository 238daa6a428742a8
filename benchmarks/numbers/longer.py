"""What a run finds with `--all`: the results of every other benchmark."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import models
from mechanism_fmu.engine.compiler.subset import COMPILES
from mechanism_fmu.model import MechanismError
from mechanism_fmu.processors import processors

from .. import crowd, growth
from ..timing import Comparison
from .number import Number, Part, is_here
from .quick import of_limits

if TYPE_CHECKING:
    from ..endurance import Endured
    from ..model_exchange import BothWays
    from ..peers.result import Result

#: Minutes of all parts, those of `quick` too.
MINUTES = 11
#: Rounds of a comparison, of the growth and of the processors: as those commands have them.
_ROUNDS, _OF_GROWTH, _OF_PROCESSORS = 9, 7, 5
_TICKS = 5000
_AT_LIMITS = 100
#: Units of times [s]: the first that the limit reaches is that of the number.
_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def parts() -> list[Part]:
    """All of them."""
    return [
        *_comparisons(_ROUNDS),
        Part("growth", lambda _: growth_of(_OF_GROWTH), ("numba",)),
        Part("crowds", lambda _: crowds(), ("numba",)),
        Part("processors", lambda _: cores(_OF_PROCESSORS), ("numba", "pyarrow", "ziglang")),
        Part("many designs", lambda folder: many(folder, _ROUNDS), ("mujoco", "numba", "scipy")),
        Part("a day of ticks", lambda _: ticks(_TICKS)),
        Part(f"designs at the limits, {_AT_LIMITS} a model", lambda _: of_limits(_AT_LIMITS)),
        Part("endurance", lambda _: endurance(), ("ziglang",), (MechanismError,)),
        Part("Model Exchange", model_exchange, ("scipy", "ziglang")),
        Part("other programs", lambda _: peers(), ("scipy",)),
    ]


# Speed.


def _comparisons(rounds: int) -> list[Part]:
    if not is_here("scipy"):  # what they are all compared with
        return [Part("the comparisons of python -m benchmarks", lambda _: (), ("scipy",))]
    from ..comparisons import PARTS

    def numbers(compare: Callable[[Path, int], list[Comparison]]) -> Callable[[Path], Iterator[Number]]:
        return lambda folder: judged(compare(folder, rounds))

    return [Part(part.title, numbers(part.compare), ("numba",), part.lacks) for part in PARTS]


def judged(comparisons: Iterable[Comparison]) -> Iterator[Number]:
    """Of each comparison what its requirement is about: a time where that must stay short, else the ratio."""
    for one in comparisons:
        name = f"{one.subject}: {one.case}"
        if one.longest is None:
            yield Number("speed", f"{name}, times as fast", "1", one.ratio)
        else:
            unit, seconds = next((unit, seconds) for unit, seconds in _UNITS.items() if one.longest >= seconds)
            yield Number("speed", name, unit, median(one.fast) / seconds)


def growth_of(rounds: int, sizes: Sequence[int] = growth.SIZES, many: Sequence[int] = growth.LARGE) -> Iterator[Number]:
    """One acceleration of mechanisms of all sizes, and whole motions.

    Args:
        rounds: of which the median counts.
        sizes: bars of the chains.
        many: bodies of the motions.
    """
    if not COMPILES:
        raise RuntimeError("NUMBA_DISABLE_JIT is set: what is timed would run as plain Python.")
    times = {}
    for count in sizes:
        timed, _ = growth.accelerations(growth.chain(count))
        times[count] = median(timed() for _ in range(rounds))
        yield Number("speed", f"acceleration of a chain of {count}", "us", 1e6 * times[count])
    larger = {count: seconds for count, seconds in times.items() if count >= 20}
    name = f"acceleration of a chain, power of the number of bars from {min(larger)} to {max(larger)}"
    yield Number("speed", name, "1", growth.exponent(larger))
    for name, seconds in growth.others(rounds):
        yield Number("speed", f"acceleration of {name}", "us", 1e6 * seconds)
    for one in growth.motions(rounds, many):
        for count, seconds in one.times.items():
            yield Number("speed", f"{count} {one.name}", "ms", 1e3 * seconds)
        yield Number("speed", f"{one.name}, power of their number", "1", one.exponent)
        most = max(one.written)
        yield Number("speed", f"{most} {one.name}: written of the block", "MB", one.written[most])


def crowds(counts: Sequence[int] = crowd.COUNTS) -> Iterator[Number]:
    """An impact in crowds of balls.

    Args:
        counts: of balls.
    """
    found = list(crowd.measure(counts))
    for one in found:
        yield Number("speed", f"an impact among {one.count} balls, all kept", "ms", 1e3 * one.kept)
    if len(found) > 1:
        times = {one.count: one.kept for one in found}
        yield Number("speed", "an impact among balls, power of their number", "1", growth.exponent(times))


def cores(rounds: int) -> Iterator[Number]:
    """Of each job, how many times faster all processors are than one."""
    from .. import cores

    most = processors()
    for name, one, several in cores.measure(most, rounds):
        yield Number("speed", f"{name}: {most} workers, times as fast as one", "1", one / several)


def many(folder: Path, rounds: int) -> Iterator[Number]:
    """A sweep beside MuJoCo's rollout and beside `solve_ivp` in processes."""
    from ..many.compare import compare

    return judged(compare(folder, rounds, lambda _: None)[0])


def ticks(count: int) -> Iterator[Number]:
    """A day of ticks, from so many."""
    from .. import escapement

    for teeth, tolerance in escapement.CASES:
        seconds = escapement.run(teeth, tolerance, count).of_a_day
        yield Number("speed", f"a day of ticks, {teeth} teeth, at {tolerance:.0e}", "s", seconds)


# What is counted.


def endurance(*counts: int) -> list[Number]:
    """What grows and drifts, in a process of its own, whose memory nothing else has touched.

    Args:
        counts: of instances, steps and impacts; without them, as many as the command does.
    """
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        return list(endured(pool.submit(_endure, counts).result()))


def _endure(counts: Sequence[int]) -> list[Endured]:
    from ..endurance import measure

    return list(measure(*counts))


def endured(found: Iterable[Endured]) -> Iterator[Number]:
    """Memory and time of each, and the drift."""
    for one in found:
        of_each = f"of {one.count:,}"
        if one.before:
            grown = (one.after - one.before) / one.count
            yield Number("endurance", f"memory grown by each {one.each} {of_each}", "B", grown)
        yield Number("endurance", f"time of each {one.each} {of_each}", "us", 1e6 * one.seconds / one.count)
        if one.drift is not None:
            yield Number("endurance", f"drift of the energy in {one.count:,} {one.each}s, relative", "1", one.drift)


def model_exchange(folder: Path, count: int | None = None) -> Iterator[Number]:
    """Designs of all models in Model Exchange and in co-simulation; so many of each, or as many as the command runs."""
    from ..model_exchange import COUNT, MODELS, both_ways, designs

    todo = {name: designs(models.load(name).MODEL, count or COUNT) for name in MODELS}
    return exchanged([both_ways(name, some, folder) for name, some in todo.items()])


def exchanged(found: Sequence[BothWays]) -> Iterator[Number]:
    """Counts over all models, and of each how many times as long it takes."""
    yield Number("exchange", "designs tried", "1", sum(one.tried for one in found))
    yield Number("exchange", "of these, start", "1", sum(one.tried - one.refused for one in found))
    ran = [one for one in found if one.apart]
    yield Number("exchange", "of these, run both ways", "1", sum(len(one.apart) for one in ran))
    if ran:
        yield Number("exchange", "ends apart, at most", "1", max(max(one.apart) for one in ran))
        yield Number("exchange", "events of a design, at most", "1", max(max(one.events) for one in ran))
        yield Number("exchange", "events that follow at one instant, at most", "1", max(one.at_once for one in ran))
    for one in ran:
        yield Number("exchange", f"{one.model}: times as long as co-simulation", "1", one.slower)


def peers() -> Iterator[Number]:
    """All cases by all programs that are installed."""
    from ..peers.cases import CASES
    from ..peers.result import run_all

    return verdicts(run_all(list(CASES.values()), lambda runs: runs))


def verdicts(results: Iterable[Result]) -> Iterator[Number]:
    """Of each peer at its own best accuracy its time over ours; 0 where ours is not as accurate."""
    for result in results:
        for one in result.verdicts:
            peer = f"{one.peer.code}, {one.peer.method}"
            yield Number("peers", f"{result.case.title}: {peer}, time over ours", "1", one.ratio)
