"""Mechanisms of the gallery that hold by dry friction, and let go: shafts with clutch and brake, wedge, disc."""

import math

import numpy as np
import pytest
from gallery_examples import simulation

from mechanism_fmu.simulation import Simulation

GRAVITY = 9.81
FIRST, SECOND = 0.5 * 20.0 * 0.2**2, 0.5 * 32.0 * 0.25**2  # inertias of the shafts


def events(running: Simulation, until: float) -> list[tuple[str, float]]:
    """Names and times of all events up to a time [s]."""
    running.advance(until)
    return [(event.guard, event.time) for event in running.events_in_step()]


# The shafts.


@pytest.mark.parametrize(("drive", "clutch", "brake", "speed"), [(2.0, 9.0, 5.0, 40.0), (-1.0, 7.0, 2.5, 100.0)])
def test_the_shafts_stop_when_and_where_constant_torques_say(drive, clutch, brake, speed) -> None:
    fast, slow = (drive - clutch) / FIRST, (clutch - brake) / SECOND
    alike = speed / (slow - fast)
    turns = slow * alike
    both = (drive - brake) / (FIRST + SECOND)
    stops = alike - turns / both
    together = -0.5 * turns**2 / both
    running = simulation("braked_shaft", speed=speed, clutch=clutch, brake=brake)
    running.set_input("drive", drive)
    running.advance(0.5 * (alike + stops))
    ((name, time),) = ((event.guard, event.time) for event in running.events_in_step())
    assert (name, time) == ("clutch.sticks", pytest.approx(alike, rel=1e-11))
    now = running.read()
    assert now["clutched"] == 1.0
    assert now["first"] == pytest.approx(turns + both * (0.5 * (alike + stops) - alike), rel=1e-10)
    assert now["second"] == pytest.approx(now["first"], rel=1e-12)
    assert now["clutch_torque"] == pytest.approx(FIRST * both - drive, rel=1e-10, abs=1e-10 * abs(drive))
    assert events(running, stops + 1.0) == [("brake.sticks", pytest.approx(stops, rel=1e-11))]
    before = running.read()
    wanted = [speed * alike + 0.5 * fast * alike**2 + together, 0.5 * slow * alike**2 + together]
    np.testing.assert_allclose([before["first_angle"], before["second_angle"]], wanted, rtol=1e-10)
    np.testing.assert_allclose([before["clutch_torque"], before["brake_torque"]], -drive, rtol=1e-9)
    running.advance(stops + 3600.0)
    after = running.read()
    for name in ("first_angle", "second_angle"):
        assert after[name] == pytest.approx(before[name], rel=0, abs=1e-12)


def test_the_brake_holds_up_to_its_torque_and_the_clutch_turns_the_shaft_beyond() -> None:
    running = simulation("braked_shaft", speed=0.0)
    running.set_input("drive", 0.0)
    running.advance(1.0)
    running.set_slope("drive", 1.0)
    # both turn alike until the clutch would have to give more than 9 N m: 5 + (drive - 5) J2/(J1 + J2) = 9
    slips = 1.0 + 5.0 + 4.0 * (FIRST + SECOND) / SECOND
    wanted = [("brake.slips", pytest.approx(6.0, abs=1e-9)), ("clutch.slips", pytest.approx(slips, abs=1e-9))]
    assert events(running, slips + 1.0) == wanted
    speed = 0.5 * (slips - 6.0) ** 2 / (FIRST + SECOND) + 4.0 / SECOND
    assert running.read()["second"] == pytest.approx(speed, rel=1e-9)


# The wedge.


def squeezed(angle: float, friction: float, wedge: float, load: float, push: float = 0.0) -> float:
    """Acceleration of the wedge outwards [m/s2], both faces slipping, in closed form.

    The load presses with R inclined by phi: M (g - a tan(alpha)) = R cos(alpha - phi); the floor, likewise, gives
    m a = R sin(alpha - phi) - mu (m g + R cos(alpha - phi)) + push.
    """
    t = math.tan(angle)
    drives = math.tan(angle - math.atan(friction)) - friction
    return (GRAVITY * (load * drives - friction * wedge) + push) / (wedge + load * t * drives)


@pytest.mark.parametrize(
    ("degrees", "friction", "wedge", "load"), [(20, 0.15, 1.0, 30.0), (10, 0.08, 0.1, 5.0), (35, 0.2, 2.0, 10.0)]
)
def test_the_wedge_is_squeezed_out_as_in_the_closed_form(degrees, friction, wedge, load) -> None:
    angle = math.radians(degrees)
    assert angle > 2 * math.atan(friction)
    wanted = squeezed(angle, friction, wedge, load)
    running = simulation("wedge", angle=angle, friction=friction, wedge=wedge, load=load)
    at = running.read()
    running.advance(0.1)
    now = running.read()
    moved = [now["speed"], now["x"] - at["x"], now["height"] - at["height"]]
    np.testing.assert_allclose(moved, [0.1 * wanted, 5e-3 * wanted, -5e-3 * wanted * math.tan(angle)], rtol=1e-9)
    normal = load * (GRAVITY - wanted * math.tan(angle)) / (math.cos(angle) + friction * math.sin(angle))
    assert now["normal"] == pytest.approx(normal, rel=1e-9)


@pytest.mark.parametrize("degrees", [5, 20, 35, 60])
@pytest.mark.parametrize("wedge", [1e-3, 2.0])
def test_it_locks_itself_from_its_angle_on(degrees: float, wedge: float) -> None:
    """It moves where the closed form has it move; without weight, mu = tan(alpha/2) parts both."""
    angle, load = math.radians(degrees), 30.0
    low, high = 0.0, 2.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if squeezed_out(angle, middle, wedge, load) else (low, middle)
    assert high == pytest.approx(math.tan(angle / 2), rel=1e-3 if wedge < 1.0 else 0.2)
    for friction, moves in ((high * (1 - 1e-6), True), (high * (1 + 1e-6), False)):
        running = simulation("wedge", angle=angle, friction=friction, wedge=wedge, load=load)
        at = running.read()["x"]
        running.advance(1.0)
        now = running.read()
        assert (now["x"] - at > 1e-6) == moves
        assert moves or abs(now["speed"]) < 1e-10


def squeezed_out(angle: float, friction: float, wedge: float, load: float) -> bool:
    """Whether what drives the wedge out is more than what its own weight holds."""
    return load * (math.tan(angle - math.atan(friction)) - friction) > friction * wedge


def test_it_is_driven_in_by_more_than_the_load_times_its_tangents() -> None:
    angle, friction, wedge, load = math.radians(20), 0.15, 1.0, 30.0
    bound = GRAVITY * (load * (math.tan(angle + math.atan(friction)) + friction) + wedge * friction)
    running = simulation("wedge")
    running.set_input("push", -(1 - 1e-6) * bound)
    at = running.read()["x"]
    running.advance(0.5)
    assert running.read()["x"] == pytest.approx(at, abs=1e-12)
    running.set_input("push", -1.5 * bound)
    running.advance(0.6)
    drives = math.tan(angle + math.atan(friction)) + friction
    wanted = -0.5 * bound / (wedge + load * math.tan(angle) * drives)
    assert running.read()["speed"] == pytest.approx(0.1 * wanted, rel=1e-9)


# The disc.


@pytest.mark.parametrize(
    ("velocity", "backspin", "friction", "radius"),
    [(2.0, 60.0, 0.25, 0.1), (2.0, 10.0, 0.25, 0.1), (3.0, 0.0, 0.1, 0.3), (1.0, 10.0, 0.4, 0.2)],
)
def test_the_disc_rolls_from_the_closed_form_s_time_on(velocity, backspin, friction, radius) -> None:
    slip = velocity + radius * backspin
    rolls = slip / (3 * friction * GRAVITY)
    wanted = (2 * velocity - radius * backspin) / 3
    running = simulation("backspin", thrown=velocity, backspin=backspin, friction=friction, radius=radius)
    assert running.read()["slip"] == pytest.approx(slip, rel=1e-12)
    assert running.read()["drag"] == pytest.approx(-friction * 1.5 * GRAVITY, rel=1e-12)
    assert events(running, 2 * rolls) == [("floor.sticks", pytest.approx(rolls, rel=1e-10))]
    now = running.read()
    x = velocity * rolls - 0.5 * friction * GRAVITY * rolls**2 + wanted * rolls
    np.testing.assert_allclose([now["velocity"], now["x"]], [wanted, x], rtol=1e-9, atol=1e-12)
    assert now["speed"] == pytest.approx(-wanted / radius, rel=1e-9, abs=1e-12)
    assert (now["slip"], now["rolls"]) == (0.0, 1.0)
    assert now["drag"] == pytest.approx(0.0, abs=1e-9)
    assert now["energy_lost"] == pytest.approx(1.5 * slip**2 / 6, rel=1e-9)
