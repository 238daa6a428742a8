"""The turn as tables: all of it for files, a few of its rows and columns for people."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from mechanism_fmu.elastodynamics import SpeedSweep

from ...fmu.description import Description
from ...fmu.values import in_display_unit
from .solution import Rigid, Solution
from .synthesis import Synthesised

#: Of parameters; the search rounds to as many.
_DIGITS = 9
#: Modes whose frequencies are shown, and harmonics of the crank that may meet them.
_MODES, _HARMONICS = 3, 6


@dataclass(frozen=True)
class Shown:
    """A table for people: headings with units, and rows of texts."""

    headings: list[str]
    rows: list[list[str]]

    def every(self, stride: int) -> Shown:
        """Each `stride`-th row."""
        return Shown(self.headings, self.rows[::stride])

    def without(self, columns: Iterable[int]) -> Shown:
        """Without some columns."""
        dropped = set(columns)
        kept = [k for k in range(len(self.headings)) if k not in dropped]
        return Shown([self.headings[k] for k in kept], [[row[k] for k in kept] for row in self.rows])


def cycle_table(found: Solution) -> tuple[pd.DataFrame, dict[str, str]]:
    """Everything at every angle, in SI units, and the unit of each column."""
    columns: dict[str, tuple[object, str]] = {
        "crank_angle": (found.angle, "rad"),
        "rigid_x": (found.rigid.path[:, 0], "m"),
        "rigid_y": (found.rigid.path[:, 1], "m"),
    }
    for kind, bent in (("quasi_static", found.static), ("elastodynamic", found.dynamic)):
        for k, name, unit in ((0, "x", "m"), (1, "y", "m"), (2, "rotation", "rad")):
            columns[f"{kind}_{name}"] = bent.deflection[:, k], unit
        columns[f"{kind}_deviation"] = bent.deviation, "m"
        for member, stress in zip(found.members, bent.stress.T, strict=True):
            columns[f"{kind}_stress_{member}"] = stress, "Pa"
    columns["input_torque"] = found.rigid.torque, "N.m"
    columns |= _frame_columns(found.rigid)
    for mode in range(found.modes):
        columns[f"natural_frequency_{mode + 1}"] = found.frequencies[:, mode], "Hz"
    table = pd.DataFrame({name: values for name, (values, _) in columns.items()})
    return table, {name: unit for name, (_, unit) in columns.items()}


def _frame_columns(rigid: Rigid) -> dict[str, tuple[object, str]]:
    """Forces on the frame and in the joints, and what was asked for besides: friction, the speed with a flywheel."""
    columns: dict[str, tuple[object, str]] = {
        "shaking_force_x": (rigid.shaking.force[:, 0], "N"),
        "shaking_force_y": (rigid.shaking.force[:, 1], "N"),
        "shaking_moment": (rigid.shaking.moment, "N.m"),
    }
    for joint in rigid.joints:
        columns[f"joint_force_{joint.joint}"] = joint.force, "N"
        if rigid.rubs:
            kind, unit = ("torque", "N.m") if joint.turning else ("force", "N")
            columns[f"friction_{kind}_{joint.joint}"] = joint.friction, unit
    if rigid.flywheel is not None:
        columns["crank_speed_with_flywheel"] = rigid.flywheel.speed, "rad/s"
    return columns


def speeds_table(sweep: SpeedSweep) -> tuple[pd.DataFrame, dict[str, str]]:
    """Largest deviations by the crank's speed, in SI units, and the unit of each column."""
    units = {"crank_speed": "rad/s", "quasi_static_deviation": "m", "elastodynamic_deviation": "m"}
    return pd.DataFrame(dict(zip(units, (sweep.speed, sweep.static, sweep.dynamic), strict=True))), units


def cycle_rows(found: Solution) -> Shown:
    """The turn in the units of a drawing: rigid path, deflection, deviations, stresses, torque, force on the frame."""
    millimetres = 1e3 * np.column_stack(
        [
            found.rigid.path,
            found.dynamic.deflection[:, :2],
            found.static.deviation,
            found.dynamic.deviation,
        ]
    )
    stresses = 1e-6 * found.dynamic.stress
    headings = ["phi [deg]", "x [mm]", "y [mm]", "dx [mm]", "dy [mm]", "dev qs [mm]", "dev ed [mm]"]
    headings += [f"{member} [MPa]" for member in found.members]
    rows = [
        [
            f"{angle:g}",
            *(f"{number:.2f}" for number in place[:2]),
            *(f"{number:.4f}" for number in place[2:]),
            *(f"{number:.1f}" for number in stress),
            f"{torque:.3f}",
            f"{force:.1f}",
            f"{moment:.3f}",
        ]
        for angle, place, stress, torque, force, moment in zip(
            found.degrees.tolist(),
            millimetres.tolist(),
            stresses.tolist(),
            found.rigid.torque.tolist(),
            found.rigid.shaking_force.tolist(),
            found.rigid.shaking.moment.tolist(),
            strict=True,
        )
    ]
    return Shown([*headings, "torque [N.m]", "shake F [N]", "shake M [N.m]"], rows)


def narrow_columns(found: Solution) -> list[int]:
    """Columns of `cycle_rows` that a narrow terminal can do without: path and deflection, and the smaller stresses."""
    largest = int(np.argmax(found.dynamic.largest_stress))
    return [1, 2, 3, 4, *(7 + k for k in range(len(found.members)) if k != largest)]


def frequency_rows(found: Solution) -> Shown:
    """Of the lowest modes: least, mean and largest frequency, and speeds at which harmonics of the crank meet them."""
    headings = ["mode", "least [Hz]", "mean [Hz]", "largest [Hz]"]
    headings += [f"h={h + 1} [rpm]" for h in range(_HARMONICS)]
    rows = []
    for mode in range(min(_MODES, found.modes)):
        least, largest = found.frequency_range[mode]
        mean = found.critical[mode, 0] / (2 * math.pi)
        critical = (f"{speed * 30 / math.pi:.0f}" for speed in found.critical[mode, :_HARMONICS])
        rows.append([f"{mode + 1}", f"{least:.2f}", f"{mean:.2f}", f"{largest:.2f}", *critical])
    return Shown(headings, rows)


def largest_rows(found: Solution) -> Shown:
    """The largest deviation and stress of both solutions, and where they are."""
    solutions = [
        (kind, bent, int(np.argmax(bent.largest_stress)))
        for kind, bent in (("quasi-static", found.static), ("elastodynamic", found.dynamic))
    ]
    rows = [
        [
            kind,
            f"{1e3 * bent.largest_deviation:.5f}",
            f"{math.degrees(bent.largest_at):.3f}",
            f"{1e-6 * bent.largest_stress[member]:.2f}",
            found.members[member],
            f"{round(math.degrees(bent.stress_at[member]), 9):g}",
        ]
        for kind, bent, member in solutions
    ]
    return Shown(["", "deviation [mm]", "at [deg]", "stress [MPa]", "in", "at [deg]"], rows)


def joint_rows(found: Solution) -> Shown:
    """What each joint carries at most and, where joints rub, its friction and what that takes in a turn."""
    rigid = found.rigid
    parts = zip(rigid.joints, rigid.largest_forces, rigid.largest_friction, rigid.lost_energy.tolist(), strict=True)
    rows = [
        [
            *(joint.joint, f"{force.value:.2f}", f"{force.degrees:g}"),
            *(f"{friction.value:.4g}", "N.m" if joint.turning else "N", f"{lost:.4g}"),
        ]
        for joint, force, friction, lost in parts
    ]
    headings = ["joint", "largest force [N]", "at [deg]", "largest friction", "", "lost in a turn [J]"]
    return Shown(headings, rows).without(() if rigid.rubs else (3, 4, 5))


def frame_sentence(found: Solution) -> str:
    """The largest shaking force and moment, and where."""
    force, moment = found.rigid.largest_shaking
    x, y = (1e3 * float(c) for c in found.rigid.shaking.about)
    return (
        f"On the frame: shaking force up to {force.value:.4g} N at {force.degrees:g} deg; shaking moment about "
        f"({x:g}, {y:g}) mm up to {moment.value:.4g} N.m at {moment.degrees:g} deg."
    )


def feedback_sentence(found: Solution) -> str:
    """How far the paper's way to the periodic motion goes."""
    fed, what = found.feedback, "Fed back into the inertia forces, the elastic acceleration"
    deviation = f"with a largest deviation of {1e3 * fed.largest_deviation:.5g} mm"
    if fed.converged:
        return f"{what} settles in {fed.rounds} rounds, {deviation}."
    return (
        f"{what} settles to {fed.change:.2g} of the quasi-static deviation after {fed.rounds} rounds and no further, "
        f"{deviation}; the periodic motion is found without it."
    )


def flywheel_sentence(found: Solution) -> str:
    """The flywheel that was asked for; "" if none was."""
    wheel = found.rigid.flywheel
    if wheel is None:
        return ""
    (least, largest), rpm = found.rigid.flywheel_speeds, 30 / math.pi
    return (
        f"Flywheel for a coefficient of fluctuation of {wheel.coefficient:g}: {wheel.inertia:.4g} kg.m2 on the crank "
        f"= {found.rigid.fluctuation.energy:.4g} J / ({wheel.coefficient:g} x ({found.speed:.5g} rad/s)^2). Under a "
        f"constant drive torque the crank then turns at {least * rpm:.5g} to {largest * rpm:.5g} rpm."
    )


def friction_sentence(found: Solution) -> str:
    """What friction takes in a turn; "" without friction."""
    if not found.rigid.rubs:
        return ""
    lost = float(found.rigid.lost_energy.sum())
    return (
        f"Friction takes {lost:.4g} J in a turn, {lost * found.speed / (2 * math.pi):.4g} W at this speed: the mean of "
        f"the input torque is {found.rigid.fluctuation.mean:.4g} N.m."
    )


def synthesis_rows(found: Synthesised, description: Description) -> Shown:
    """Each parameter, the mass, and how much of the limits is used, before and after."""
    rows = []
    for bound, before, after in zip(found.bounds, found.start.tolist(), found.design.tolist(), strict=True):
        (old, unit), (new, _) = (in_display_unit(value, bound.name, description, _DIGITS) for value in (before, after))
        ends = (in_display_unit(value, bound.name, description, _DIGITS)[0] for value in (bound.least, bound.largest))
        rows.append([bound.name, old, new, unit, " .. ".join(ends)])
    before, after, limits = found.before, found.after, found.limits
    rows.append(["mass of all members", f"{before.mass:.5g}", f"{after.mass:.5g}", "kg", ""])
    for what, factor, unit, limit in (
        ("deviation", 1e3, "mm", limits.deviation),
        ("stress", 1e-6, "MPa", limits.stress),
    ):
        old, new = (f"{factor * getattr(judged, what).max():.5g}" for judged in (before, after))
        rows.append([f"largest {what}", old, new, unit, "" if limit is None else f"at most {factor * limit:g}"])
    return Shown(["", "before", "after", "unit", "allowed"], rows)
