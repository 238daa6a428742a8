"""The page docs/validation/peers.md and its figure, all of it made of what was run."""

from __future__ import annotations

import math
import platform
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from harness.report.plot import Curve, Plot
from harness.report.static import svg_text
from mechanism_fmu.processors import processors

from ..world.pages import FOLDER
from .case import EXACT, OURS, Point, Verdict
from .programs import PEERS, Peer
from .result import Result

PAGE, FIGURE = FOLDER / "peers.md", FOLDER / "peers.svg"
_CPU = Path("/proc/cpuinfo")

#: Of the curves, one for each way of a case, by code; a second way of the same code takes the next of `_FURTHER`.
_COLOURS = {OURS: "#1f6feb", "MuJoCo": "#d1242f", "scipy": "#2da44e", "pymunk": "#bf8700", "Exudyn": "#8250df"}
_FURTHER = "#bf3989"
#: Errors below are drawn as this.
_LEAST = 1e-16


def page(results: Sequence[Result], peers: Sequence[Peer], today: date) -> str:
    """The page, in Markdown."""
    versions = ", ".join(f"{peer.code} {peer.version}" for peer in peers if peer.version)
    missing = " ".join(absent(peer) for peer in peers if not peer.version)
    parts = [
        "# Beside other programs",
        "The same problem by this engine and by programs that can state it: error against time.",
        f"Made by `python -m benchmarks.peers` on {today.day} {today:%B %Y}; {versions}; {machine()}. "
        f"No number here was typed by hand. {missing}".rstrip(),
        "## Where a peer is ahead",
        ahead(results),
        "## Each peer at its own best accuracy",
        best(results),
        "Ratio: the peer's time over ours, at the fastest of our tolerances that is at least as accurate; above 1 this "
        "engine is ahead. Errors below the floor of the reference, which a case names, are not told apart: it is at "
        "least three times what scipy's program, at its tightest, differs from it.",
        "![](peers.svg)",
        "## What a peer cannot state",
        unstated(results),
        *(part for result in results for part in _section(result)),
        "## What is measured",
        f"Error: the largest difference of all compared quantities from this engine at a tolerance of {EXACT:.0e}; how "
        "far scipy's program, which shares nothing with it, agrees stands in the tables. Time: of the processor, for "
        "the run alone, without making the model; the least of three. MuJoCo and Exudyn make all steps in one call of "
        "theirs; pymunk is called for each step from Python, as it is used; scipy's equations are written with numpy. "
        "The best accuracy of a peer is the best of the settings in its table; with the largest numbers of steps "
        "there, errors of the first order still fall, and times rise as fast.",
    ]
    return "\n\n".join(parts) + "\n"


def ahead(results: Sequence[Result]) -> str:
    """What is said first: where a peer is faster at its own best accuracy, and where at a coarser setting."""
    lines = []
    for result in results:
        lines += [f"- **{result.case.title}**: {_told(one)}." for one in result.verdicts if one.is_ahead]
    best_of = "At its own best accuracy"
    first = f"{best_of}:\n\n" + "\n".join(lines) if lines else f"{best_of}: no peer, in no case."
    coarse = [
        f"- {result.case.title}: {_told(one)}."
        for result in results
        for one in result.overtaken
        if not (one.is_ahead and one in result.verdicts)
    ]
    ended = [
        f"- {result.case.title}: at {point.setting}."
        for result in results
        for point in result.points
        if point.code == OURS and not math.isfinite(point.error)
    ]
    paragraphs = [first]
    if coarse:
        paragraphs += ["At a coarser setting, the most accurate one where it is ahead:", "\n".join(coarse)]
    else:
        paragraphs.append("At another setting: no peer either.")
    if ended:
        paragraphs += ["Where this engine ends with a message in place of a result:", "\n".join(ended)]
    return "\n\n".join(paragraphs)


def best(results: Sequence[Result]) -> str:
    """The table of verdicts, with those first where a peer is ahead."""
    rows = [
        "| case | peer | setting | time [ms] | error | ours: tolerance | time [ms] | error | ratio |",
        "| --- | --- | --- | ---: | ---: | --- | ---: | ---: | ---: |",
    ]
    pairs = [(result.case, verdict) for result in results for verdict in result.verdicts]
    for case, one in sorted(pairs, key=lambda pair: not pair[1].is_ahead):
        peer, ours = one.peer, one.ours
        cells = [case.title, f"{peer.code}, {peer.method}", peer.setting, _ms(peer), _error(peer)]
        cells += (
            ["none", "", ""] if ours is None else [ours.setting.removeprefix("tolerance "), _ms(ours), _error(ours)]
        )
        rows.append(f"| {' | '.join(cells)} | {f'**{one.ratio:.2g}**' if one.is_ahead else f'{one.ratio:.3g}'} |")
    return "\n".join(rows)


def unstated(results: Sequence[Result]) -> str:
    """The table of what peers cannot say."""
    rows = ["| case | peer | |", "| --- | --- | --- |"]
    rows += [f"| {one.case.title} | {code} | {why} |" for one in results for code, why in one.case.cannot.items()]
    return "\n".join(rows)


def picture(results: Sequence[Result]) -> str:
    """The figure as SVG: a panel for each case."""
    return svg_text([_panel(result) for result in results])


def absent(peer: Peer) -> str:
    """That a peer is left out, and how it is installed."""
    return f"{peer.code} is not installed and left out: `python -m pip install -e '.[bench]'` ({PEERS[peer.code]})."


def machine() -> str:
    """The machine in a few words."""
    lines = _CPU.read_text(encoding="utf-8").splitlines() if _CPU.is_file() else []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return f"{named[0] if named else platform.machine()}, {processors()} processors, {platform.system()}"


def _told(one: Verdict) -> str:
    peer, ours = one.peer, one.ours
    its = f"{peer.code} ({peer.method}, {peer.setting}) takes {_ms(peer)} ms for an error of {_error(peer)}"
    if ours is None:
        return f"{its}; this engine is not as accurate at any tolerance"
    return f"{its}; this engine, at {ours.setting.removeprefix('tolerance ')}, {_ms(ours)} ms for {_error(ours)}"


def _section(result: Result) -> list[str]:
    rows = ["| code | method | setting | time [ms] | error |", "| --- | --- | --- | ---: | ---: |"]
    rows += [f"| {one.code} | {one.method} | {one.setting} | {_ms(one)} | {_error(one)} |" for one in result.points]
    floor = f"Floor of the reference: {result.case.floor:.0e}."
    return [f"## {result.case.title}", f"{result.case.statement} {floor}", "\n".join(rows)]


def _panel(result: Result) -> Plot:
    ways = list(dict.fromkeys((point.code, point.method) for point in result.points))
    curves, seen = [], set()
    for code, method in ways:
        its = [one for one in result.points if (one.code, one.method) == (code, method) and math.isfinite(one.error)]
        several = sum(other == code for other, _ in ways) > 1
        name = f"{code}, {method.split()[0]}" if several else code
        x = [math.log10(1e3 * one.seconds) for one in its]
        y = [math.log10(max(one.error, _LEAST)) for one in its]
        if its:
            curves.append(Curve(name, x, y, _FURTHER if code in seen else _COLOURS[code], dots=True))
        seen.add(code)
    return Plot(result.case.title, "log10 of processor time [ms]", "log10 of error", curves)


def _ms(point: Point) -> str:
    return f"{1e3 * point.seconds:.3g}"


def _error(point: Point) -> str:
    return f"{point.error:.1e}" if math.isfinite(point.error) else "ends with a message"
