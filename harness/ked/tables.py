"""The turn as tables: all of it for files, a few of its rows and columns for people."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from .solution import Solution

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
    for mode in range(found.modes):
        columns[f"natural_frequency_{mode + 1}"] = found.frequencies[:, mode], "Hz"
    table = pd.DataFrame({name: values for name, (values, _) in columns.items()})
    return table, {name: unit for name, (_, unit) in columns.items()}


def cycle_rows(found: Solution) -> Shown:
    """The turn in the units of a drawing: rigid path, deflection, deviations, stresses, torque."""
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
        ]
        for angle, place, stress, torque in zip(
            found.degrees.tolist(), millimetres.tolist(), stresses.tolist(), found.rigid.torque.tolist(), strict=True
        )
    ]
    return Shown([*headings, "torque [N.m]"], rows)


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
    rows = []
    for kind, bent in (("quasi-static", found.static), ("elastodynamic", found.dynamic)):
        member = int(np.argmax(bent.largest_stress))
        rows.append(
            [
                kind,
                f"{1e3 * bent.largest_deviation:.5f}",
                f"{math.degrees(bent.largest_at):.3f}",
                f"{1e-6 * bent.largest_stress[member]:.2f}",
                found.members[member],
                f"{round(math.degrees(bent.stress_at[member]), 9):g}",
            ]
        )
    return Shown(["", "deviation [mm]", "at [deg]", "stress [MPa]", "in", "at [deg]"], rows)
