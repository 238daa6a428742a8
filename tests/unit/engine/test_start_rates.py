"""Start rates: what follows a driver or a held coordinate, and what is said where they do not agree with the joints."""

import math
import re

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, AngleDriver, Body, Mechanism, MechanismError, Revolute, polynomial_motion
from mechanism_fmu.simulation import Simulation
from tests.driven_four_bar import CRANK, GROUND_LENGTH, MODEL, ROCKER, START


def driven(**values: float) -> Mechanism:
    return MODEL.build(MODEL.values(**values))


def undriven(mechanism: Mechanism, *held: str) -> Mechanism:
    joints = tuple(joint for joint in mechanism.joints if joint.name != "drive")
    return Mechanism(mechanism.bodies, joints, held=held)


def rates(simulation: Simulation) -> np.ndarray:
    return np.array(simulation.field("y_end")[9:18])


def angles(crank: float, coupler: float = 0.18) -> tuple[float, float]:
    """Of coupler and rocker, by the law of cosines."""
    pin = (CRANK * math.cos(crank), CRANK * math.sin(crank))
    x, y = GROUND_LENGTH - pin[0], -pin[1]
    across = math.hypot(x, y)
    phi = math.atan2(y, x) + math.acos((coupler**2 + across**2 - ROCKER**2) / (2 * coupler * across))
    tip = (pin[0] + coupler * math.cos(phi), pin[1] + coupler * math.sin(phi))
    return phi, math.atan2(tip[1], tip[0] - GROUND_LENGTH)


def speeds(crank_speed: float) -> np.ndarray:
    """Of coupler and rocker, by differences."""
    return crank_speed * (np.array(angles(START + 1e-5)) - angles(START - 1e-5)) / 2e-5


def test_bodies_without_rates_follow_a_driver_that_moves_though_nothing_is_held() -> None:
    simulation = Simulation(driven(drive_speed=3.0))
    found = rates(simulation)
    assert found[2] == pytest.approx(3.0, rel=1e-14)
    np.testing.assert_allclose(found[[5, 8]], speeds(3.0), rtol=1e-9)
    given = Simulation(undriven(driven(crank_speed=3.0), "crank.angle"))
    np.testing.assert_allclose(found, rates(given), rtol=0, atol=1e-14)
    simulation.advance(0.1)
    assert simulation.field("y_end")[2] >= START + 0.3 * (1 - 1e-12)


def test_one_that_the_driven_body_is_given_is_kept() -> None:
    found = rates(Simulation(driven(crank_speed=3.0)))
    assert found[2] == 3.0
    np.testing.assert_allclose(found[[5, 8]], speeds(3.0), rtol=1e-9)


def said(mechanism: Mechanism) -> str:
    with pytest.raises(MechanismError, match=r"^The start rates do not agree with the joints\. ") as refusal:
        Simulation(mechanism)
    return str(refusal.value)


def asked(text: str) -> dict[str, tuple[list[float], list[float]]]:
    """By body: the rates that the joints ask for, and those that were given."""
    found = re.findall(r"body '(\w+)' \((.*?)\), not \((.*?)\)", text)
    return {name: ([*map(float, a.split(", "))], [*map(float, b.split(", "))]) for name, a, b in found}


def test_without_a_driver_the_rates_are_said_that_the_given_ones_ask_of_others() -> None:
    text = said(undriven(driven(crank_speed=3.0)))
    found = asked(text)
    assert list(found) == ["coupler", "rocker"]
    for body, speed in zip(("coupler", "rocker"), speeds(3.0), strict=True):
        assert found[body][0][2] == pytest.approx(speed, rel=1e-5)
        assert found[body][1] == [0, 0, 0]
    assert "Name in held the coordinate whose rate you mean, as 'crank.angle'" in text
    assert " by 0" not in text


def test_against_a_driver_the_body_is_named_that_was_given_another_rate() -> None:
    found = asked(said(driven(crank_speed=5.0, drive_speed=3.0)))
    assert found["crank"][0][2] == pytest.approx(3.0, rel=1e-5)
    assert found["crank"][1][2] == 5.0


def test_a_held_rate_against_the_driver_is_named() -> None:
    made = driven(drive_speed=3.0)
    found = asked(said(Mechanism(made.bodies, made.joints, held=("crank.angle",))))
    assert (found["crank"][0][2], found["crank"][1][2]) == (pytest.approx(3.0, rel=1e-5), 0.0)


def test_a_lever_whose_centre_stands_still_is_told_its_velocity() -> None:
    """The nearest rates that agree, by hand: (0, w l, w) with 1 - w = l^2 w, for a hinge l = 0.5 m from the centre."""
    lever = Body("lever", 1.0, 1.0, (0.5, 0.0, 0.0), (0.0, 0.0, 1.0))
    text = said(Mechanism((lever,), (Revolute("hinge", "lever", (-0.5, 0.0), GROUND, (0.0, 0.0)),)))
    assert asked(text) == {"lever": ([0.0, pytest.approx(0.4), pytest.approx(0.8)], [0.0, 0.0, 1.0])}


def test_drivers_that_contradict_each_other_are_named_and_no_body() -> None:
    hinge = Revolute("hinge", "lever", (0.0, 0.0), GROUND, (0.0, 0.0))
    both = (AngleDriver(name, "lever", polynomial_motion(0.0, speed)) for name, speed in (("slow", 1.0), ("fast", 3.0)))
    text = said(Mechanism((Body("lever", 1.0, 1.0),), (hinge, *both)))
    assert "what is left: slow by 1, fast by 1 (m/s, or rad/s)" in text
    assert "hinge" not in text
    assert asked(text) == {}
