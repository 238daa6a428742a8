"""Pages of docs/validation: one a case and their index, all of it made of what was run."""

from __future__ import annotations

import inspect
import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from harness.report.plot import Curve, Plot
from harness.report.static import svg_text

from .case import SHOWN, Case, Known, Run, Work

FOLDER = Path(__file__).parents[2] / "docs" / "validation"
_ROOT = FOLDER.parents[1]
_BLUE = "#1f6feb"
#: Deviations below are drawn as this.
_LEAST = 1e-16
#: Of a page that `benchmarks.peers` writes.
_BESIDE = "Error against time of MuJoCo, scipy, pymunk and Exudyn as well: [beside other programs](peers.md)."


@dataclass(frozen=True)
class Result:
    """A case, what it gives at the two tolerances of `SHOWN`, and its work-precision diagram."""

    case: Case
    runs: tuple[Run, ...]
    works: tuple[Work, ...]


def page(result: Result, today: date) -> str:
    """The page of a case, in Markdown."""
    case = result.case
    parts = [
        f"# {case.title}",
        f"{case.statement}",
        f"Source: {case.source}.",
        f"Made by `python -m benchmarks.world {case.name}` on {_day(today)}.",
        "## Values",
        _values(result),
        *([case.remark] if case.remark else []),
        *([f"![]({case.name}_more.svg)"] if case.drawings else []),
        "## Work and precision",
        f"![]({case.name}.svg)",
        _works(result.works),
        "Deviation: the largest of all quantities, relative to the known value (absolute where that is 0). "
        "Time: of the "
        "processor, with making and assembling the mechanism; the least of three, where one takes less than a second.",
        "## Model",
        _model(case),
    ]
    return "\n\n".join(parts) + "\n"


def index(results: Sequence[Result], today: date) -> str:
    """The page of all cases."""
    rows = [
        "| case | source | quantities | largest deviation at 1e-9 | at 1e-12 | published digits |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for result in results:
        case = result.case
        off = (_short(case.deviation(run)) for run in result.runs)
        cells = (f"[{case.title}]({case.name}.md)", case.source, str(len(case.known)), *off, _published(result))
        rows.append(f"| {' | '.join(cells)} |")
    names = "\n".join(result.case.name for result in results)
    parts = [
        "# Validation",
        "Problems that others have stated, with what they have published or what a formula says, beside this "
        "engine's results. "
        "What is compared with what in the tests: [verification and limits](../verification.md).",
        f"Made by `python -m benchmarks.world` on {_day(today)}; nothing in the table was typed by hand.",
        "\n".join(rows),
        "Deviations are relative to the known value, absolute where that is 0. A value that nobody has "
        "printed is not called "
        "published: it comes from a closed form, from an equation of the one coordinate, solved by scipy to 1e-13, "
        "from a second formulation of the problem, written by hand and solved without the engine, or from another "
        "program.",
        _BESIDE,
        f"```{{toctree}}\n:hidden:\n\n{names}\npeers\n```",
    ]
    return "\n\n".join(parts) + "\n"


def picture(result: Result) -> str:
    """The diagram as SVG: how far results are off, over the processor time that they take."""
    x = [math.log10(1e3 * one.seconds) for one in result.works]
    y = [math.log10(max(one.deviation, _LEAST)) for one in result.works]
    curve = Curve("mechanism_fmu", x, y, _BLUE, dots=True)
    return svg_text([Plot(result.case.title, "log10 of processor time [ms]", "log10 of deviation", [curve])])


def drawings(case: Case) -> str | None:
    """The other pictures of its page, below each other, as SVG."""
    return svg_text(case.drawings()) if case.drawings else None


def _values(result: Result) -> str:
    heads = [f"at {tolerance:.0e}".replace("e-0", "e-") for tolerance in SHOWN]
    rows = [
        f"| quantity | {' | '.join(heads)} | known | from | deviation |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for number, known in enumerate(result.case.known):
        found = [run.values[number] for run in result.runs]
        digits = " | ".join(f"{value:.16g}" for value in found)
        printed = known.value if isinstance(known.value, str) else f"{known.value:.16g}"
        cells = f"{_named(known)} | {digits} | {printed} | {known.origin} | {_short(known.deviation(found[-1]))}"
        rows.append(f"| {cells} |")
    return "\n".join(rows)


def _named(known: Known) -> str:
    return f"{known.name} [{known.unit}]"


def _works(works: Sequence[Work]) -> str:
    rows = ["| tolerance | steps | time [ms] | deviation |", "| --- | --- | --- | --- |"]
    rows += [
        f"| {one.tolerance:.0e} | {one.steps} | {1e3 * one.seconds:.3g} | {_short(one.deviation)} |" for one in works
    ]
    return "\n".join(rows)


def _model(case: Case) -> str:
    if isinstance(case.model, Path):
        where = case.model.relative_to(_ROOT).as_posix()
        if where.startswith("models/"):  # ready-made ones have pages of their own
            return f"The ready-made one: [`{where}`](../../{where})."
        text = case.model.read_text(encoding="utf-8")
    else:
        text = inspect.getsource(case.model)
        where = f"benchmarks/world/cases/{case.name}.py"
    return f"`{where}`:\n\n```python\n{text.strip()}\n```"


def _published(result: Result) -> str:
    published = [known for known in result.case.known if known.origin == "published"]
    if not published:
        return "none"
    return f"{len(published) - len(result.case.unreached(result.runs[-1]))} of {len(published)}"


def _short(deviation: float) -> str:
    return f"{deviation:.1e}" if deviation else "0"


def _day(today: date) -> str:
    return f"{today.day} {today:%B %Y}"
