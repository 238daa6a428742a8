"""Whole pages of many designs and of an optimum, beside what they were: see tests/kept.py."""

from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest
from cheap_designs import SQUARE, axis, cheap_sweep
from fake_slave import FakeFmu, FakeSlave, fake_description

from harness.designs.by_fmu import InMotion
from harness.designs.optimum_file import Constraint, Goal, Optimum
from harness.designs.search import Best, History
from harness.designs.sensitivity import Sensitivity
from harness.designs.task import Design, Quantity, Result, Task, When
from harness.report.optimum_report import Found, optimum_report
from harness.report.sweep_report import sweep_report
from harness.run.inputs import InputSignals
from harness.run.master import TimeGrid
from tests.kept import plain_page, same_as_kept

TORQUES = InputSignals(
    (fake_description().variable("drive_torque"),), np.array([0.0, 2.0]), np.array([[0.0], [1.0]]), "drive.csv", "ab12"
)
FMU = FakeFmu(FakeSlave())
ANGLE = Quantity(When.FIRST_IMPACT, "wheel_angle", "Real", "rad", "deg")
#: From 1e-3 to 10: only its logarithm shows all of it.
WIDE = Quantity(When.MAX, "wide", "Real", "Pa")
TASK = Task(TimeGrid.of(1.0, 0.1), {"crank_inertia": 1e-4}, TORQUES, (SQUARE, ANGLE, WIDE))


def results(designs: list[Design], quantities: tuple[Quantity, ...], warned: bool) -> pa.Table:
    """Of numbers that are all different; the third design fails, the last one says nothing of one quantity."""
    count = len(designs)
    columns = {
        "design": [design.number for design in designs],
        "status": ["failed" if design.number == 3 else "ok" for design in designs],
        "way": ["batch" if design.number % 2 else "single" for design in designs],
        "message": ["it <stalls>" if design.number == 3 else None for design in designs],
        "warnings": [
            f"gap of {design.number / 8:g} m" if warned and design.number > count - 3 else None for design in designs
        ],
    }
    for name in designs[0].values:
        columns[name] = [design.values[name] for design in designs]
    for k, quantity in enumerate(quantities):
        values: list[float | None] = [0.1 * n * (k + 1) + 0.01 for n in range(count)]
        if quantity == WIDE:
            values = [10.0 ** (4 * n / count - 3) for n in range(count)]
        columns[quantity.column] = [
            None if design.number == 3 else v for design, v in zip(designs, values, strict=True)
        ]
    columns[quantities[1].column][-1] = None
    return pa.table(columns)


@pytest.mark.parametrize("warned", [False, True])
def test_kept_page_of_a_sweep(warned: bool) -> None:
    axes = (
        axis("tooth_slope_angle", 85.0, 95.0, unit="deg"),
        replace(axis("tooth_count"), values=(10, 20)),
        axis("restitution", 0.0, 0.5),
    )
    designs = [
        Design(n, {"tooth_slope_angle": 1.48 + 0.02 * n, "tooth_count": 10 + 10 * (n % 2), "restitution": 0.1 * n})
        for n in range(1, 6)
    ]
    sweep = replace(cheap_sweep(4), axes=axes, task=TASK)
    seen = InMotion("Design 5, the one with the largest of all.")
    html = sweep_report(sweep, FMU, results(designs, TASK.quantities, warned), seen)  # type: ignore[arg-type]
    same_as_kept(f"sweep_{'warned' if warned else 'quiet'}.html", plain_page(html))


class Search:
    """A history that is told."""

    def __init__(self, designs: list[Design], results: list[Result]) -> None:
        self.designs, self.results = designs, results


@pytest.mark.parametrize("largest", [False, True])
def test_kept_page_of_an_optimum(largest: bool) -> None:
    axes = (
        axis("tooth_slope_angle", 1400.0, 1700.0, unit="mrad"),
        replace(axis("tooth_count"), values=(10, 20)),
        axis("gear", 1, 9),
    )
    designs = [
        Design(n, {"tooth_slope_angle": 1.48 + 0.02 * n, "tooth_count": 10 + 10 * (n % 2), "gear": n})
        for n in range(1, 7)
    ]
    quantities = (SQUARE, ANGLE, WIDE)
    found = [
        Result(n, "single", (None if n == 3 else (4.0 - n) ** 2 + 1.5, 0.3 * n, 7.0), *(("failed",) if n == 3 else ()))
        for n in range(1, 7)
    ]
    constraints = (
        (Constraint(ANGLE, 0.5, 1.7), Constraint(WIDE, None, 6.0)) if largest else (Constraint(ANGLE, 0.5, None),)
    )
    optimum = Optimum(
        "Valley",
        replace(TASK, quantities=quantities),
        axes,
        Goal(SQUARE, largest, constraints),
        "CMA",
        6,
        7,
        False,
        (),
        None,
    )
    best = Best(designs[4], found[4], not largest)
    near = Sensitivity(
        ("tooth_slope_angle", "gear"),
        np.array([0.25, 0.5]),
        np.array([0.375, 0.75]),
        0.125,
        2.5,
        ((86.0, 88.0), (2, 4)),
    )
    history: History = Search(designs, found)  # type: ignore[assignment]
    page = optimum_report(
        optimum,
        Found(best, None if largest else near, history, results(designs, quantities, True), None),
        FMU,  # type: ignore[arg-type]
    )
    same_as_kept(f"optimum_{'largest' if largest else 'smallest'}.html", plain_page(page))
