"""A driver that comes to the end of its range is named with what it asks for there."""

import math
import re
from dataclasses import replace

import pytest

from mechanism_fmu.model import (
    GROUND,
    Curve,
    Mechanism,
    Revolute,
    Settings,
    Translational,
    XDriver,
    bar,
    harmonic_motion,
    polynomial_motion,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation, SimulationError
from tests.driven_four_bar import MODEL, ROCKER, START, end_of_range

_SAID = re.compile(
    r"t = (\S+) s: The joints cannot be kept from here on: a driver has come to the end of its range, .*"
    r"Driver '(\w+)' asks for (\S+) (m|rad) here, and goes on\."
)


def go_on(simulation: Simulation, step: float, until: float) -> None:
    while simulation.time < until:
        simulation.advance(simulation.time + step)


def said(mechanism: Mechanism, step: float = 0.01, until: float = 10.0) -> tuple[float, str, float, str]:
    simulation = Simulation(mechanism)
    with pytest.raises(SimulationError) as failure:
        go_on(simulation, step, until)
    found = _SAID.fullmatch(str(failure.value))
    assert found, str(failure.value)
    assert simulation.time == pytest.approx(float(found[1]), rel=1e-8)
    return float(found[1]), found[2], float(found[3]), found[4]


@pytest.mark.parametrize(
    ("coupler", "speed", "end"),
    [
        (0.18, 3.0, end_of_range(0.18 + ROCKER)),  # stretched
        (0.18, -0.1, end_of_range(0.18 - ROCKER)),  # folded
        (0.1, 300.0, end_of_range(0.1 + ROCKER)),
        (0.1, -3.0, -end_of_range(0.1 + ROCKER)),
    ],
)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_a_crank_that_cannot_turn_fully(coupler: float, speed: float, end: float, tolerance: float) -> None:
    made = MODEL.build(MODEL.values(coupler=coupler, drive_speed=speed))
    made = replace(made, settings=Settings(relative_tolerance=tolerance))
    time, name, angle, unit = said(made, 0.03 / abs(speed))
    assert (name, unit) == ("drive", "rad")
    assert angle == pytest.approx(end, rel=5e-6)  # six digits are shown
    assert time == pytest.approx((end - START) / speed, rel=1e-5)


def slider_crank(*motions: tuple[str, Curve]) -> Mechanism:
    """A crank of 0.1 m and a rod of 0.3 m, whose slider is driven in x, from a right angle between the two on."""
    far = math.hypot(0.1, 0.3)
    pin = (0.01 / far, math.sqrt(0.01 - 0.0001 / far**2))
    crank, rod = bar("crank", (0, 0), pin, mass=1.0), bar("rod", pin, (far, 0), mass=1.0)
    slider = rigid_body("slider", (far, 0), mass=1.0, inertia=1.0)
    joints = (
        Revolute("A", crank.a, GROUND.at(0, 0)),
        Revolute("B", crank.b, rod.a),
        Revolute("C", rod.b, slider.at(0, 0)),
        Translational("guide", GROUND.line((0, 0), (1, 0)), slider.line((0, 0), (1, 0))),
    )
    other = rigid_body("other", mass=1.0, inertia=1.0)
    still = (Translational("track", GROUND.line((0, 0), (1, 0)), other.line((0, 0), (1, 0))),)
    drivers = tuple(XDriver(name, "slider" if name == "pull" else "other", (0, 0), motion) for name, motion in motions)
    return Mechanism((crank, rod, slider, other), (*joints, *still, *drivers))


FAR = math.hypot(0.1, 0.3)


def test_of_several_drivers_the_one_is_named_that_cannot_go_on() -> None:
    """The slider gets no further than crank and rod in line, 0.4 m, however fast another body moves."""
    made = slider_crank(("shake", polynomial_motion(0.0, 50.0)), ("pull", polynomial_motion(FAR, 0.2)))
    time, name, place, unit = said(made)
    assert (name, unit) == ("pull", "m")
    assert place == pytest.approx(0.4, rel=1e-6)
    assert time == pytest.approx((0.4 - FAR) / 0.2, rel=1e-5)


def test_a_driver_that_turns_back_in_time_is_not_meant() -> None:
    """0.1 % before the end of its range."""
    swing = 0.999 * (0.4 - FAR)
    made = slider_crank(("shake", polynomial_motion(0.0)), ("pull", harmonic_motion(FAR, swing, 3.0)))
    simulation = Simulation(made)
    simulation.advance(3.0)
    assert simulation.field("y_end")[6] <= FAR + swing * (1 + 1e-9)
