"""The paper's parameter study: one FMU, twenty wheels."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pandas as pd

from ...errors import FmuError, UsageError
from ...fmu.description import Description, Value
from ...fmu.interface import Instances
from ...run.checks import Check, Finding
from ...run.drawing import Drawing, Quantity, read_drawing
from ...run.experiment import Experiment, Run, perform
from ...run.results import settings, versions, write_json, write_with_units
from .accuracy import accuracy_findings
from .wheels import BASE_CASE, SLOPE_ANGLES_DEG, TOOTH_COUNTS, WHEEL_UNITS, Wheel, study_checks

# The rim of a toothed wheel, as the drawing in its FMU has it.

#: The places of corners: (x, y) [m], shape (corners,) each.
Outline = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


@dataclass(frozen=True)
class Rim:
    """The corners of one pitch, which the wheel repeats.

    Attributes:
        count: number of teeth, >= 1.
        radii: distance of each corner from the wheel's centre [m]; the first is the root of a tooth.
        angles: of each corner, from the wheel's x axis [rad].
        clockwise: whether the teeth follow each other clockwise.
    """

    count: int
    radii: tuple[float, ...]
    angles: tuple[float, ...]
    clockwise: bool

    def wheel(self) -> Outline:
        """The whole rim about the wheel's centre, closed: its last corner is its first."""
        turns = np.repeat(np.arange(self.count), len(self.radii))
        angles = np.tile(self.angles, self.count) + turns * self._pitch
        radii = np.tile(self.radii, self.count)
        return _closed(radii * np.cos(angles)), _closed(radii * np.sin(angles))

    def tooth(self) -> Outline:
        """One tooth from its root to the next one, as the paper's Fig. 5 shows it.

        Its root is the origin, the wheel's radius there points up, and the next root lies to the right.
        """
        radii = np.array([*self.radii, self.radii[0]])
        angles = np.array([*self.angles, self.angles[0] + self._pitch]) - self.angles[0]
        side = -1.0 if self.clockwise else 1.0
        return side * radii * np.sin(angles), radii * np.cos(angles) - radii[0]

    @property
    def _pitch(self) -> float:
        return (-1 if self.clockwise else 1) * 2 * np.pi / self.count


def _closed(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    return np.append(values, values[0])


def rim_of(drawing: Drawing, parameters: Mapping[str, Value]) -> Rim | None:
    """The rim of the first wheel of a drawing; None when it has none that parameters alone describe.

    Args:
        drawing: of an FMU.
        parameters: all parameters and calculated parameters of an instance.
    """
    for shape in drawing.shapes:
        quantities = [shape.quantities["count"], *sum(shape.outline, ())] if shape.kind == "wheel" else []
        if quantities and all(_known(quantity, parameters) for quantity in quantities):
            count, *numbers = (_number(quantity, parameters) for quantity in quantities)
            return Rim(round(count), tuple(numbers[::2]), tuple(numbers[1::2]), shape.clockwise)
    return None


def _known(quantity: Quantity, parameters: Mapping[str, Value]) -> bool:
    return not isinstance(quantity, str) or quantity.removeprefix("-") in parameters


def _number(quantity: Quantity, parameters: Mapping[str, Value]) -> float:
    if not isinstance(quantity, str):
        return quantity
    value = float(parameters[quantity.removeprefix("-")])
    return -value if quantity.startswith("-") else value


#: The first impact comes before 0.96 s in every case.
_STOP_TIME = 1.2
#: Impacts are located inside a step, so the step may be large; in the base case one wants to see the motion.
_STEP, _BASE_CASE_STEP = 0.1, 0.01

_NUMBER = re.compile(r"\d+(\.\d+)?(e[+-]?\d+)?")

_NEEDED = ("tooth_count", "tooth_slope_angle", "tooth_length", "tooth_apex_angle", "impacts[1].velocity")


@dataclass(frozen=True)
class Study:
    """What came of the study.

    Attributes:
        fmu: path of the FMU file.
        description: of the FMU.
        wheels: each with its first impact.
        rims: the shape of each wheel.
        parameters: also calculated ones, and inputs at the start, by name, with their values for each wheel.
        base_case: the run of the wheel that Table 2 of the paper belongs to, in fine steps.
        warnings: what the FMU said, once for all that differ in their numbers only, with the wheels concerned.
        checks: the paper's claims about its results.
        findings: what it says of its accuracy, weighed against other computations.
    """

    fmu: Path
    description: Description
    wheels: tuple[Wheel, ...]
    rims: tuple[Rim, ...]
    parameters: Mapping[str, tuple[Value, ...]]
    base_case: Run
    warnings: tuple[str, ...]
    checks: tuple[Check, ...]
    findings: tuple[Finding, ...]


def ratchet_study(fmu: Instances, on_wheel: Callable[[int, int], None]) -> Study:
    """Run all wheels of the paper through one FMU.

    Args:
        fmu: a ratchet.
        on_wheel: called after each wheel with its number and the number of all.

    Raises:
        UsageError: the FMU is no ratchet.
        FmuError: it fails with a wheel, or a wheel has no impact.
    """
    for name in _NEEDED:
        if name not in fmu.description.variables:
            raise UsageError(f"{fmu.description.model} is no ratchet: it has no variable '{name}'.")
    drawing = read_drawing(fmu.folder, fmu.description)
    wheels: list[Wheel] = []
    rims: list[Rim] = []
    runs: list[Run] = []
    warnings: dict[str, list[tuple[str, Wheel]]] = {}
    cases = list(itertools.product(TOOTH_COUNTS, SLOPE_ANGLES_DEG))
    for count, angle in cases:
        step = _BASE_CASE_STEP if (count, angle) == BASE_CASE else _STEP
        run = _performed(fmu, step, count, math.radians(angle))
        rim = rim_of(drawing, run.parameters)
        if rim is None:
            raise UsageError(
                drawing.objection or f"{fmu.description.model} is no ratchet: its drawing has no wheel of known shape."
            )
        runs.append(run)
        rims.append(rim)
        wheels.append(_first_impact(run))
        for message in run.messages:
            if message.needs_attention:
                warnings.setdefault(_NUMBER.sub("", message.text), []).append((message.text, wheels[-1]))
        on_wheel(len(wheels), len(cases))
    made = [settings(run) for run in runs]
    return Study(
        fmu=fmu.path,
        description=fmu.description,
        wheels=tuple(wheels),
        rims=tuple(rims),
        parameters={name: tuple(case[name] for case in made) for name in made[0]},
        base_case=runs[cases.index(BASE_CASE)],
        warnings=tuple(map(_listed_once, warnings.values())),
        checks=study_checks(wheels),
        findings=accuracy_findings(wheels),
    )


def _listed_once(said: list[tuple[str, Wheel]]) -> str:
    """A warning that differs in its numbers only, with the wheels it was said about: the first one's text for all."""
    first = said[0][0]
    same = "; ".join(str(wheel) for text, wheel in said if text == first)
    alike = "; ".join(str(wheel) for text, wheel in said if text != first)
    return f"{first} ({same}{f'; with other numbers also {alike}' if alike else ''})"


def _performed(fmu: Instances, step: float, count: int, angle: float) -> Run:
    """The run of one wheel, which has an impact."""
    run = perform(fmu, Experiment(_STOP_TIME, step, {"tooth_count": count, "tooth_slope_angle": angle}))
    if run.outcome.error is not None:
        raise run.outcome.error
    if run.impacts.empty:
        raise FmuError(
            f"{fmu.description.model} with tooth_count = {count}, tooth_slope_angle = {angle:.6g} rad has no impact "
            f"until {_STOP_TIME:g} s."
        )
    return run


def _first_impact(run: Run) -> Wheel:
    first = run.impacts.iloc[0]
    return Wheel(
        tooth_count=int(run.parameters["tooth_count"]),
        tooth_slope_angle=float(run.parameters["tooth_slope_angle"]),
        impact_time=float(first["time"]),
        wheel_speed=float(first["wheel_speed"]),
        impact_velocity=float(first["velocity"]),
        stress_max=float(first["stress_max"]),
        stress_position=float(first["stress_position"]),
        stress_delay=float(first["stress_delay"]),
        tooth_length=float(run.parameters["tooth_length"]),
        tooth_apex_angle=float(run.parameters["tooth_apex_angle"]),
    )


def write_study(study: Study, folder: Path) -> list[Path]:
    """Write study.csv (a row for each wheel, units in the headings) and study.json (also verdicts, warnings, versions).

    All numbers are in SI units.

    Raises:
        UsageError: the disk refuses.
    """
    rows = [asdict(wheel) | {"slenderness": wheel.slenderness} for wheel in study.wheels]
    summary = {
        "versions": versions(study.fmu, study.description),
        "units": WHEEL_UNITS,
        "wheels": rows,
        "parameters": study.parameters,
        "checks": [asdict(check) for check in study.checks],
        "findings": [asdict(finding) for finding in study.findings],
        "warnings": list(study.warnings),
    }
    units = {name: unit for name, unit in WHEEL_UNITS.items() if unit != "1"}
    return [
        write_with_units(pd.DataFrame(rows), units, folder / "study.csv"),
        write_json(folder / "study.json", summary),
    ]
