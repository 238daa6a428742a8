"""When clicks, copies of patterns and logical functions change, for bodies that turn freely: closed forms."""

import math

import pytest

from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Body,
    CircularPattern,
    LogicalFunction,
    Mechanism,
    Output,
    PointLineContact,
    Torque,
)
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import MARGIN

WITHIN = 4 * MARGIN
PITCH = math.tau / 8


def wheel(*contacts, angle=0.0, speed=1.0, others=(), torque=0.0, **parts):
    """A wheel of unit inertia that turns freely about its centre."""
    return Simulation(
        Mechanism(
            bodies=(Body("wheel", 1.0, 1.0, (0.0, 0.0, angle), (0.0, 0.0, speed)), *others),
            forces=(Torque("drive", "wheel", torque=torque),),
            contacts=contacts,
            outputs=(Output("angle", "wheel.angle", ""),),
            **parts,
        )
    )


def guards_and_times(simulation, until):
    simulation.advance(until)
    events = simulation.events_in_step()
    return [event.guard for event in events], [event.time for event in events]


@pytest.mark.parametrize("speed", [0.5, 3.0])
def test_a_stop_with_memory_clicks_at_every_pitch(speed):
    simulation = wheel(AngleStop("pawl", "wheel", GROUND, 0.1, 0.5), angle=0.2, speed=speed)
    guards, times = guards_and_times(simulation, 1.9 / speed)
    assert guards == ["pawl.click"] * 3
    assert times == pytest.approx([(0.1 + 0.5 * k - 0.2) / speed for k in (1, 2, 3)], abs=WITHIN / speed)
    assert simulation.field("contact_clicks")[0] == 3


@pytest.mark.parametrize(("angle", "clicks"), [(0.59, 0), (0.61, 1), (1.09, 1), (1.3, 2), (3.2, 6)])
def test_pitches_that_are_passed_at_the_start_click_there(angle, clicks):
    simulation = wheel(AngleStop("pawl", "wheel", GROUND, 0.1, 0.5), angle=angle, speed=0.0)
    assert guards_and_times(simulation, 1.0) == (["pawl.click"] * clicks, [0.0] * clicks)
    assert simulation.field("contact_clicks")[0] == clicks


@pytest.mark.parametrize("options", [{"pitch": None}, {"pitch": 0.5, "enabled": False}])
def test_a_stop_without_memory_or_existence_does_not_click(options):
    simulation = wheel(AngleStop("pawl", "wheel", GROUND, 0.1, **options), angle=0.2)
    assert guards_and_times(simulation, 3.0) == ([], [])


def test_a_wheel_that_turns_back_strikes_the_stop_behind_its_last_click():
    """angle = 0.2 + t - t^2 / 2 has its summit 0.7 at t = 1, beyond one pitch from 0.1, and comes back to 0.6."""
    simulation = wheel(AngleStop("pawl", "wheel", GROUND, 0.1, 0.5), angle=0.2, speed=1.0, torque=-1.0)
    guards, times = guards_and_times(simulation, 2.0)
    assert guards == ["pawl.click", "pawl.gap"]
    assert times == pytest.approx([1 - math.sqrt(0.2), 1 + math.sqrt(0.2)], abs=1e-9)
    assert simulation.read()["angle"] == pytest.approx(0.6, abs=1e-9)


def toothed(speed, **options):
    """A ball rests at (1, 0); the boundary between copies 0 and 1 stands at half a pitch."""
    half = PITCH / 2
    pattern = CircularPattern(
        "teeth", "ball", (0, 0), "wheel", PITCH, (0.0, 0.0), (-math.sin(half), math.cos(half)), **options
    )
    face = PointLineContact("face", "ball", (0.0, 0.0), "wheel", (0.5, 0.0), (1.0, 0.0), pattern="teeth")
    return wheel(face, speed=speed, others=(Body("ball", 1.0, 1.0, (1.0, 0.0, 0.0)),), patterns=(pattern,))


@pytest.mark.parametrize(("speed", "guard", "step"), [(0.4, "teeth.previous", -1), (-0.4, "teeth.next", 1)])
def test_the_next_copy_comes_when_the_point_passes_the_boundary(speed, guard, step):
    simulation = toothed(speed)
    guards, times = guards_and_times(simulation, 3.9 * PITCH / 0.4)
    assert guards == [guard] * 4
    assert times == pytest.approx([(k + 0.5) * PITCH / 0.4 for k in range(4)], abs=4e-9)
    assert simulation.field("pattern_copy")[0] == 4 * step


def test_a_pattern_that_is_switched_off_has_one_copy():
    simulation = toothed(-0.1, enabled=False)
    assert guards_and_times(simulation, 0.9 * PITCH / 0.1) == ([], [])


def test_a_function_of_an_angle_changes_at_its_limit_and_back():
    """angle = 2 t - t^2 / 2 passes 1.5 at t = 1 and t = 3."""
    lock = AngleLock("lock", "wheel", GROUND, 0.0, 1.0, closed_while="far")
    functions = (
        LogicalFunction("near", of="wheel.angle", below=1.5),
        LogicalFunction("far", of="wheel.angle", below=-9),
    )
    simulation = wheel(lock, speed=2.0, torque=-1.0, functions=functions)
    guards, times = guards_and_times(simulation, 3.5)
    assert guards == ["near", "near"]
    assert times == pytest.approx([1.0, 3.0], abs=WITHIN)


@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_a_function_of_the_place_along_a_line_changes_at_its_limit(speed):
    """A ball goes along x from -+1 on; the line's point is (0, 0) and its limit at 0.25."""
    ball = Body("ball", 1.0, 1.0, (-math.copysign(1.0, speed), 0.3, 0.0), (speed, 0.0, 0.0))
    rail = PointLineContact("rail", "ball", (0.0, 0.3), GROUND, (0.0, 0.6), (0.0, 1.0), closed_while="f")
    function = LogicalFunction("f", of="rail.along", below=0.25)
    simulation = wheel(rail, others=(ball,), functions=(function,), speed=0.0)
    guards, times = guards_and_times(simulation, 1.0)
    assert guards == ["f"]
    within = WITHIN * simulation.field("scales")[0]  # a margin of lengths, at 2 m/s
    assert times == pytest.approx([(1.0 + math.copysign(0.25, speed)) / 2.0], abs=within)
