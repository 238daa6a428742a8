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


def end_values(key: str, form: Form, fmu: Path, folder: Path) -> Values:
    """Outputs at the end of a run. `folder` is empty and stays so for this run alone."""
    return hosted(key, asked(fmu, folder, form.event_mode))


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
    expected = {name: _run("fmpy", FORMS["fmi2"], name, fmu_of, folder / "expected") for name in names}
    for key, tool in TOOLS.items():
        for form in FORMS.values():
            if form.key not in tool.forms or tool.missing():
                yield Cell(key, form.key, None)
                continue
            yield _cell(key, tool, form, expected, fmu_of, folder)


def _cell(key: str, tool: Tool, form: Form, expected: dict[str, Values], fmu_of: FmuOf, folder: Path) -> Cell:
    largest, trouble = 0.0, []
    for name, values in expected.items():
        if not form.fits(name):
            continue
        try:
            found = _run(key, form, name, fmu_of, folder / f"{key}_{form.key}")
        except ToolError as error:
            trouble.append(f"{name}: {error}")
            continue
        if name == "ratchet":
            trouble += wrong_about_the_ratchet(found)
        off = deviation(found, values)
        largest = max(largest, off)
        if not off < tool.tolerance:
            trouble.append(f"{name}: differs from FMPy by {off:.1e}")
    return Cell(key, form.key, largest, tuple(trouble))


def _run(key: str, form: Form, name: str, fmu_of: FmuOf, folder: Path) -> Values:
    place = folder / name
    place.mkdir(parents=True)
    return end_values(key, form, fmu_of(name, form), place)
