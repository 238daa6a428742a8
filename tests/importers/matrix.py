"""The matrix: each tool on each form of each model, compared with FMPy on FMI 2.0."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.importers.asked import asked
from tests.importers.forms import FORMS, Form
from tests.importers.tool import Tool, ToolError, Values, hosted
from tests.importers.tools import TOOLS

#: The guided ratchet: time of its impact, the wheel's speed behind it and its angle after 2 s [s, rad/s, rad].
RATCHET = {"impact_time": 0.9399211769, "impact_wheel_speed": 0.0227388573, "wheel_angle": 1.344183215}
RATCHET_TOLERANCE = 1e-9
#: Of Model Exchange, by an importer's integrator at its own tolerance; co-simulation is the same in every tool.
INTEGRATED_TOLERANCE = 1e-5

FmuOf = Callable[[str, Form], Path]


@dataclass(frozen=True)
class Cell:
    """What a tool did with a form.

    Attributes:
        tool, form: keys.
        deviation: largest of all outputs of all models at the end, from FMPy's; None when it was not run.
        trouble: of each model that went wrong.
    """

    tool: str
    form: str
    deviation: float | None
    trouble: tuple[str, ...] = ()


def deviation(found: Values, expected: Values) -> float:
    """The largest difference of two runs, relative to values above 1."""
    assert found.keys() == expected.keys()
    off = [abs(found[name] - value) / max(1.0, abs(value)) for name, value in expected.items()]
    return math.inf if any(math.isnan(one) for one in off) else max(off)


def end_values(key: str, form: Form, fmu: Path, folder: Path, until: float = math.inf) -> Values:
    """Outputs at the end of a run. `folder` is empty and stays so for this run alone; `until` is that of `asked`."""
    return hosted(key, asked(fmu, folder, form, until))


def tolerance_of(tool: Tool, form: Form) -> float:
    """By how much a tool may differ from FMPy's run."""
    return INTEGRATED_TOLERANCE if form.exchange else tool.tolerance


def wrong_about_the_ratchet(found: Values) -> list[str]:
    """Numbers of the paper's case that are not reached."""
    return [
        f"{name} {found[name]!r} is not {value!r}"
        for name, value in RATCHET.items()
        if not abs(found[name] - value) < RATCHET_TOLERANCE
    ]


def matrix(models: Iterable[str], fmu_of: FmuOf, folder: Path) -> Iterator[Cell]:
    """Run what is installed.

    Args:
        models: names of ready-made models.
        fmu_of: file of a model in a form.
        folder: for files.
    """
    names = list(models)
    known: dict[tuple[str, float], Values] = {}

    def expected(name: str, until: float) -> Values:
        if (name, until) not in known:
            known[name, until] = _run("fmpy", FORMS["fmi2"], name, fmu_of, folder / f"expected_{until}", until)
        return known[name, until]

    for key, tool in TOOLS.items():
        for form in FORMS.values():
            if form.key not in tool.forms or tool.missing():
                yield Cell(key, form.key, None)
                continue
            yield _cell(key, tool, form, names, expected, fmu_of, folder)


def _cell(
    key: str,
    tool: Tool,
    form: Form,
    names: Iterable[str],
    expected: Callable[[str, float], Values],
    fmu_of: FmuOf,
    folder: Path,
) -> Cell:
    largest, trouble = 0.0, []
    for name in filter(form.fits, names):
        until = form.until(name)
        try:
            found = _run(key, form, name, fmu_of, folder / f"{key}_{form.key}", until)
        except ToolError as error:
            trouble.append(f"{name}: {error}")
            continue
        if name == "ratchet" and not form.exchange:
            trouble += wrong_about_the_ratchet(found)
        off = deviation(found, expected(name, until))
        largest = max(largest, off)
        if not off < tolerance_of(tool, form):
            trouble.append(f"{name}: differs from FMPy by {off:.1e}")
    return Cell(key, form.key, largest, tuple(trouble))


def _run(key: str, form: Form, name: str, fmu_of: FmuOf, folder: Path, until: float) -> Values:
    place = folder / name
    place.mkdir(parents=True)
    return end_values(key, form, fmu_of(name, form), place, until)
