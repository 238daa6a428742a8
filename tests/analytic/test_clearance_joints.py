"""Joints with play: closed forms, the same bits as outlines written by hand, and long runs of linkages with play."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from benchmarks.world.cases.clearance_slider_crank import with_play
from mechanism_fmu.model import (
    GROUND,
    Body,
    ClearanceJoint,
    Force,
    Mechanism,
    MechanismError,
    Output,
    Settings,
    SlotClearanceJoint,
    compile_mechanism,
)
from mechanism_fmu.simulation import Simulation, simulate
from tests.analytic.linkages_with_play import four_bar_with_play, slider_crank_in_guide, slider_crank_with_play

R, C, G = 0.01, 0.002, 9.81  # pin, clearance, gravity
READINGS = ("force", "gap", "eccentricity", "contact_angle", "sliding_work", "wear_volume", "slip_speed")


def pin_in_hole(body: Body, gravity: tuple[float, float] = (0.0, -G), **numbers: Any) -> Mechanism:
    """A pin about the centre of mass of a body, in a hole about the origin of the ground."""
    joint = ClearanceJoint("j", body.at(0, 0), GROUND, **({"pin_radius": R, "clearance": C} | numbers))
    return Mechanism((body,), contacts=(joint,), gravity=gravity, outputs=read("j", body.name), settings=EXACT)


def read(joint: str, body: str) -> tuple[Output, ...]:
    """All that a joint with play shows, by its own name, motion and energy."""
    shown = [Output(name, f"{joint}.{name}", "") for name in READINGS]
    shown += [Output(name, f"{body}.{name}", "") for name in ("x", "y", "angle", "speed")]
    return (*shown, Output("lost", "energy.lost", ""), Output("kinetic", "energy.kinetic", ""))


EXACT = Settings(relative_tolerance=1e-12)


def at(mechanism: Mechanism, times: Sequence[float]) -> list[dict[str, float]]:
    simulation = Simulation(mechanism)
    found = []
    for time in times:
        simulation.advance(time)
        found.append(simulation.read())
    return found


def on_wall(angle: float, **body: Any) -> Body:
    """A body whose centre is so far from the hole's that the pin touches, at an angle from below."""
    return Body("b", 0.3, 2e-5, start=(C * math.sin(angle), -C * math.cos(angle), 0.0), **body)


def period(length: float, swing: float) -> float:
    """Of a pendulum, by the arithmetic-geometric mean."""
    a, b = 1.0, math.cos(swing / 2)
    for _ in range(8):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return 2 * math.pi / a * math.sqrt(length / G)


# Closed forms.


def test_concentric_at_first_the_pin_falls_freely_and_strikes_where_its_gap_closes() -> None:
    falls = math.sqrt(2 * C / G)
    mechanism = pin_in_hole(Body("b", 0.3, 2e-5), restitution=0.5)
    start, half, _ = at(mechanism, (0.0, falls / 2, falls * 1.1))
    assert (start["eccentricity"], start["contact_angle"], start["gap"]) == (0.0, 0.0, pytest.approx(C, rel=1e-12))
    assert half["eccentricity"] == pytest.approx(0.25, rel=1e-10)
    assert half["contact_angle"] == pytest.approx(-math.pi / 2, rel=1e-12)
    assert half["gap"] == pytest.approx(0.75 * C, rel=1e-10)
    (impact,) = simulate(mechanism, falls * 1.1, step=falls / 2).impacts
    assert impact.time == pytest.approx(falls, rel=1e-10)
    assert impact.closing_speed == pytest.approx(math.sqrt(2 * G * C), rel=1e-10)


def test_a_pin_without_friction_is_a_pendulum_as_long_as_the_clearance() -> None:
    swing = math.radians(60)
    mechanism = pin_in_hole(on_wall(swing))
    whole = period(C, swing)
    quarter, half, full = at(mechanism, (whole / 4, whole / 2, whole))
    assert quarter["contact_angle"] == pytest.approx(-math.pi / 2, abs=1e-8)
    assert quarter["force"] == pytest.approx(0.3 * G * (3 - 2 * math.cos(swing)), rel=1e-8)
    assert half["contact_angle"] == pytest.approx(-math.pi / 2 - swing, rel=1e-8)
    assert full["contact_angle"] == pytest.approx(-math.pi / 2 + swing, rel=1e-8)
    assert [one["eccentricity"] for one in (quarter, half, full)] == pytest.approx([1.0] * 3, abs=1e-8)
    # N = m g (3 cos t - 2 cos t0), and the slip is C t'
    work = 0.3 * G * C * (3 * math.sin(swing) - 2 * swing * math.cos(swing))
    assert [one["sliding_work"] / work for one in (quarter, half, full)] == pytest.approx([1.0, 2.0, 4.0], rel=1e-6)
    assert quarter["sliding_work"] == pytest.approx(work, rel=1e-8)


def test_a_pin_that_rolls_is_a_longer_pendulum_and_does_not_wear() -> None:
    swing = math.radians(40)
    body = on_wall(swing)
    longer = C * (1 + body.inertia / (body.mass * R**2))
    whole = period(longer, swing)
    shown = at(pin_in_hole(body, friction=5.0), (whole / 2, whole))
    assert shown[0]["contact_angle"] == pytest.approx(-math.pi / 2 - swing, rel=1e-8)
    assert shown[1]["contact_angle"] == pytest.approx(-math.pi / 2 + swing, rel=1e-8)
    assert shown[0]["angle"] == pytest.approx(2 * swing * C / R, rel=1e-8)
    assert shown[1]["sliding_work"] < 1e-12


@pytest.mark.parametrize("mode", [0, 1])
def test_a_hung_body_swings_as_a_double_pendulum_whose_first_link_is_the_clearance(mode: int) -> None:
    mass, inertia, long, small = 0.3, 4e-4, 0.1, 1e-5
    stiffness = np.diag([mass * G * C, mass * G * long])
    inertias = np.array([[mass * C**2, mass * C * long], [mass * C * long, inertia + mass * long**2]])
    squares, shapes = np.linalg.eig(np.linalg.solve(inertias, stiffness))
    one, two = small * shapes[:, mode] / np.abs(shapes[:, mode]).max()
    pin = (C * math.sin(one), -C * math.cos(one))
    body = Body("b", mass, inertia, start=(pin[0] + long * math.sin(two), pin[1] - long * math.cos(two), two))
    joint = ClearanceJoint("j", body.at(0.0, long), GROUND, pin_radius=R, hole_radius=R + C)
    mechanism = Mechanism((body,), contacts=(joint,), gravity=(0.0, -G), outputs=read("j", "b"), settings=EXACT)
    times = np.linspace(0.1, 1.0, 7) * 2 * math.pi / math.sqrt(squares[mode])
    shown = at(mechanism, times.tolist())
    swung = np.cos(math.sqrt(squares[mode]) * times)
    np.testing.assert_allclose([one["angle"] for one in shown], two * swung, atol=1e-6 * small)
    np.testing.assert_allclose([one["contact_angle"] + math.pi / 2 for one in shown], one * swung, atol=1e-5 * small)


def test_a_pin_circles_in_its_hole_and_no_place_of_the_wall_is_another() -> None:
    speed, turns = 0.7, 3.3
    body = Body("b", 0.3, 2e-5, start=(C, 0.0, 0.0), start_rate=(0.0, speed, 0.0))
    angle = 2 * math.pi * turns
    mechanism = pin_in_hole(body, gravity=(0.0, 0.0))
    (shown,) = at(mechanism, (angle * C / speed,))
    assert shown["contact_angle"] == pytest.approx(angle - 6 * math.pi, rel=1e-7)
    assert shown["force"] == pytest.approx(0.3 * speed**2 / C, rel=1e-8)
    assert shown["sliding_work"] == pytest.approx(0.3 * speed**2 * angle, rel=1e-8)
    assert abs(shown["slip_speed"]) == pytest.approx(speed, rel=1e-8)


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_work_of_sliding_in_an_impact_is_impulse_times_mean_slip(friction: float) -> None:
    speed, spin, e = 0.4, 300.0, 0.6
    body = Body("b", 0.3, 2e-5, start_rate=(speed, 0.0, spin))
    mechanism = pin_in_hole(body, (0.0, 0.0), restitution=e, friction=friction, wear_coefficient="2e-13 1/Pa")
    (shown,) = at(mechanism, (C / speed * 1.01,))
    impulse, slip = (1 + e) * 0.3 * speed, R * spin
    after = slip - friction * impulse * (1 / 0.3 + R**2 / 2e-5)
    assert after > 0.0
    assert shown["sliding_work"] == pytest.approx(impulse * (slip + after) / 2, rel=1e-10)
    assert shown["wear_volume"] == pytest.approx(2e-13 * shown["sliding_work"], rel=1e-12)
    normal = 0.5 * 0.3 * speed**2 * (1 - e**2)
    assert shown["lost"] == pytest.approx(normal + friction * shown["sliding_work"], rel=1e-10)


def test_a_slip_that_turns_in_an_impact_counts_both_ways() -> None:
    speed, spin, slides = 0.4, 20.0, 0.1
    body = Body("b", 0.3, 2e-5, start=(0.5 * C, 0.0, 0.0), start_rate=(speed, slides, -spin))
    mechanism = pin_in_hole(body, (0.0, 0.0), restitution=0.5)
    shown = at(mechanism, (0.0, C / speed))
    (impact,) = simulate(mechanism, C / speed, step=C / speed).impacts
    angle = math.asin(slides * impact.time / C)
    slip = slides * math.cos(angle) - speed * math.sin(angle) - R * spin  # the same after: nothing acts along it
    assert shown[1]["sliding_work"] == pytest.approx(impact.impulse * abs(slip), rel=1e-9)


# Against what outputs show, and what friction takes.


def test_work_of_sliding_times_friction_is_what_is_lost() -> None:
    body = on_wall(0.0, start_rate=(0.0, 0.0, 120.0))
    shown = at(pin_in_hole(body, friction=0.15), np.linspace(0.0, 0.8, 8001).tolist())
    work = np.array([one["sliding_work"] for one in shown])
    lost = np.array([one["lost"] for one in shown])
    np.testing.assert_allclose(0.15 * work, lost, rtol=1e-9, atol=1e-13)
    power = np.abs([one["force"] * one["slip_speed"] for one in shown])
    assert np.trapezoid(power, dx=1e-4) == pytest.approx(work[-1], rel=1e-4)
    assert work[-1] > 1e-3
    assert shown[-1]["slip_speed"] == 0.0  # it has come to roll


def test_eccentricity_and_angle_are_those_of_the_centres_in_the_frame_of_the_hole() -> None:
    pin = Body("pin", 0.2, 1e-5, start=(0.3, 0.1, 0.4), start_rate=(0.1, 0.3, 5.0))
    plate = Body("plate", 0.5, 1e-3, start=(0.25, 0.12, -0.6), start_rate=(-0.05, 0.02, -3.0), centre=(0.01, 0.0))
    hole = complex(0.3 - 0.25, 0.1 - 0.12) * complex(math.cos(0.6), math.sin(0.6))
    joint = ClearanceJoint(
        "j", pin.at(0, 0), plate.at(0.01 + hole.real, hole.imag), pin_radius="10 mm", clearance="2 mm", restitution=0.7
    )
    places = [Output(f"{b}.{q}", f"{b}.{q}", "") for b in ("pin", "plate") for q in ("x", "y", "angle")]
    mechanism = Mechanism((pin, plate), contacts=(joint,), outputs=(*read("j", "pin"), *places))
    for shown in at(mechanism, np.linspace(0.0, 0.3, 50).tolist()):
        turn = shown["plate.angle"]
        off = complex(shown["pin.x"] - shown["plate.x"], shown["pin.y"] - shown["plate.y"])
        off = off * complex(math.cos(turn), -math.sin(turn)) - hole
        assert shown["eccentricity"] == pytest.approx(abs(off) / C, abs=1e-9)
        if abs(off) > 1e-9:
            assert shown["contact_angle"] == pytest.approx(math.atan2(off.imag, off.real), abs=1e-9)
        assert shown["gap"] == pytest.approx(C - abs(off), abs=1e-9)


def test_work_of_sliding_changes_no_bit_of_the_motion() -> None:
    mechanism = pin_in_hole(Body("b", 0.3, 2e-5, start_rate=(0.2, 0.0, 3.0)), restitution=0.6, friction=0.1)
    silent = replace(mechanism, outputs=tuple(o for o in mechanism.outputs if o.source != "j.sliding_work"))
    assert at(silent, (0.3,))[0]["y"] == at(mechanism, (0.3,))[0]["y"]


def test_a_joint_that_is_switched_off_is_none() -> None:
    (shown,) = at(pin_in_hole(Body("b", 0.3, 2e-5), enabled=False), (0.1,))
    assert shown["y"] == pytest.approx(-0.5 * G * 0.01, rel=1e-10)
    assert shown["sliding_work"] == 0.0


# Slots.


def slot(body: Body, **numbers: Any) -> Mechanism:
    """A pin in a slot of the ground that goes downwards, 30 degrees, from the origin."""
    down = GROUND.line((0.0, 0.0), (math.cos(math.radians(30)), -0.5))
    joint = SlotClearanceJoint(
        "j", body.at(0, 0), down, **({"pin_radius": R, "clearance": C, "travel": 0.05} | numbers)
    )
    return Mechanism((body,), contacts=(joint,), gravity=(0.0, -G), outputs=read("j", "b"), settings=EXACT)


def test_a_pin_slides_down_a_slot_and_swings_in_its_round_end() -> None:
    below = math.radians(-120)
    start = (0.01 * math.cos(math.radians(30)) + C * math.cos(below), -0.005 + C * math.sin(below), 0.0)
    mechanism = slot(Body("b", 0.3, 2e-5, start=start))
    (slid,) = at(mechanism, (0.1,))
    far = 0.5 * G * 0.5 * 0.1**2
    assert slid["x"] == pytest.approx(start[0] + far * math.cos(math.radians(30)), rel=1e-9)
    assert slid["force"] == pytest.approx(0.3 * G * math.cos(math.radians(30)), rel=1e-9)
    assert slid["sliding_work"] == pytest.approx(slid["force"] * far, rel=1e-9)
    assert (slid["eccentricity"], slid["contact_angle"]) == pytest.approx((1.0, below), rel=1e-9)
    result = simulate(mechanism, 0.16, step=0.001)
    energy = result["kinetic"] + 0.3 * G * result["y"]
    np.testing.assert_allclose(energy, energy[0], atol=1e-9)
    assert not result.impacts
    assert max(result["x"]) > 0.05 * math.cos(math.radians(30)) + 0.5 * C  # it has been in the end
    assert np.ptp(result["contact_angle"]) > math.pi / 2


def test_a_pin_concentric_with_a_slot_strikes_its_sides() -> None:
    mechanism = slot(Body("b", 0.3, 2e-5, start=(0.02 * math.cos(math.radians(30)), -0.01, 0.0)), restitution=0.5)
    result = simulate(mechanism, 0.1, step=0.001)
    assert result["eccentricity"][0] == pytest.approx(0.0, abs=1e-12)
    assert result.impacts[0].time == pytest.approx(math.sqrt(2 * C / (G * math.cos(math.radians(30)))), rel=1e-9)
    assert max(result["eccentricity"]) < 1.0 + 1e-6


# Linkages with play.


def with_joints(mechanism: Mechanism, friction: float = 0.0) -> Mechanism:
    """The same with a part for each circle in a hole that is written by hand."""
    made = []
    for contact in mechanism.contacts:
        if contact.place == 0:
            (a, y, _), (b, _, _) = contact.outline_i.vertices
            (u, v, _), (w, _, _) = contact.outline_j.vertices
            made.append(
                ClearanceJoint(
                    contact.name,
                    contact.body_i,
                    contact.body_j,
                    point_i=((a + b) / 2, y),
                    point_j=((u + w) / 2, v),
                    pin_radius=0.05 if a - b > 0.05 else 0.01,
                    hole_radius=0.055 if a - b > 0.05 else 0.0105,
                    restitution=contact.restitution,
                    friction=friction,
                )
            )
    return replace(mechanism, contacts=tuple(made))


@pytest.mark.parametrize("tolerance", [1e-3, 3e-4, 1e-4, 3e-5])
def test_a_pin_that_slides_stays_in_its_hole_at_loose_tolerances(tolerance: float) -> None:
    """Rows of little play bend much: one correction of a large drift would leave the pin inside the rod."""
    simulation = Simulation(with_play(0.0, tolerance))
    simulation.advance(0.5)
    assert simulation.time == 0.5


LINKAGES = {"slider-crank": (slider_crank_with_play(0.4, 1), 0.2), "four-bar": (four_bar_with_play(0.8), 0.5)}


@pytest.mark.parametrize(("mechanism", "until"), LINKAGES.values(), ids=LINKAGES)
def test_the_part_gives_the_same_bits_as_outlines_written_by_hand(mechanism: Mechanism, until: float) -> None:
    by_hand, by_part = (at(one, (until / 2, until)) for one in (mechanism, with_joints(mechanism)))
    assert by_hand == by_part


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("which", LINKAGES)
def test_linkages_with_play_run_on(which: str, friction: float) -> None:
    """Ten seconds without a fault; no energy is lost or won but what the ledger says."""
    made = with_joints(LINKAGES[which][0], friction)
    joints = [joint.name for joint in made.contacts if isinstance(joint, ClearanceJoint)]
    outputs = [Output(f"{name}.{what}", f"{name}.{what}", "") for name in joints for what in READINGS[2:5]]
    outputs += [Output(what, f"energy.{what}", "") for what in ("kinetic", "work", "lost")]
    result = simulate(replace(made, outputs=tuple(outputs)), 10.0, step=0.01)
    balance = result["kinetic"] - result["work"] + result["lost"]
    np.testing.assert_allclose(balance, balance[0], atol=1e-8 * max(result["work"] + result["kinetic"]))
    for name in joints:
        assert max(result[f"{name}.eccentricity"]) < 1.0 + 1e-6
        assert (np.diff(result[f"{name}.sliding_work"]) >= 0.0).all()
    if friction > 0.0:
        work = sum(result[f"{name}.sliding_work"][-1] for name in joints)
        assert friction * work <= result["lost"][-1] * (1.0 + 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.0, 0.01, 0.1, 0.3])
@pytest.mark.parametrize(("e", "spin"), [(0.0, 0.0), (0.4, 0.0), (0.4, 5.0), (0.9, 0.0)])
def test_a_slider_in_a_guide_with_play_runs_on(e: float, spin: float, friction: float) -> None:
    """Ten seconds without a fault; the corners of the block stay between the guides."""
    shown = [Output(what, f"energy.{what}", "") for what in ("kinetic", "work", "lost")]
    shown += [Output("y", "slider.y", ""), Output("turned", "slider.angle", "", "rad")]
    result = simulate(replace(slider_crank_in_guide(e, spin, friction), outputs=tuple(shown)), 10.0, step=0.01)
    balance = result["kinetic"] - result["work"] + result["lost"]
    np.testing.assert_allclose(balance, balance[0], atol=1e-7 * balance[0])
    corners = 0.025 * np.abs(np.cos(result["turned"])) + 0.05 * np.abs(np.sin(result["turned"]))
    assert max(np.abs(result["y"]) + corners) < 0.026 + 1e-9
    assert len(result.impacts) > 50


@pytest.mark.slow
def test_plastic_impacts_without_friction_run_on() -> None:
    """At 9 s a force falls to where it hardly pulls, and once stopped the run there."""
    result = simulate(with_joints(four_bar_with_play(0.0)), 10.0, step=0.1)
    assert result["time"][-1] == 10.0


def test_work_of_sliding_of_each_turn() -> None:
    """Per turn of the crank, from the table of a run."""
    made = with_joints(slider_crank_with_play(0.4, 1), 0.01)
    outputs = (Output("turned", "crank.angle", "", "rad"), Output("worn", "play.sliding_work", "", "J"))
    result = simulate(replace(made, outputs=outputs), 0.5, step=1e-4)
    turns = result.per_turn("worn", "turned")
    assert len(turns) == int(result["turned"][-1] / (2 * math.pi))
    done = np.interp(2 * math.pi * len(turns), result["turned"], result["worn"])
    assert turns.sum() == pytest.approx(done, rel=1e-12)
    assert (turns > 0.0).all()


# What is refused.

BODY = Body("b", 1.0, 1.0)
BAD = {
    "as large as the hole": (
        {"pin_radius": 0.01, "hole_radius": 0.01},
        "must be positive, finite, and larger than pin_radius = 0.01 m: the pin has no play; use Revolute.",
    ),
    "larger": ({"pin_radius": 0.02, "hole_radius": 0.01}, "use Revolute."),
    "without play": (
        {"pin_radius": 0.01, "clearance": 0.0},
        "clearance = 0 m must be positive, finite, and larger than 1e-07 pin_radius",
    ),
    "no radius": ({"pin_radius": 0.0, "clearance": 0.1}, "pin_radius = 0 m, but it must be positive and finite."),
    "nothing": ({"pin_radius": 0.01}, "it takes a hole_radius or a clearance, and neither is given; give one of them."),
    "both": ({"pin_radius": 0.01, "hole_radius": 0.02, "clearance": 0.01}, "and both are given; give one of them."),
    "wear": ({"pin_radius": 0.01, "clearance": 0.1, "wear_coefficient": -1.0}, "wear_coefficient = -1 must be finite"),
    "restitution": ({"pin_radius": 0.01, "clearance": 0.1, "restitution": 2.0}, "restitution = 2 is outside 0..1."),
}


@pytest.mark.parametrize(("numbers", "message"), BAD.values(), ids=BAD)
def test_what_cannot_be_is_refused_by_name(numbers: dict[str, float], message: str) -> None:
    with pytest.raises(MechanismError) as refused:
        compile_mechanism(Mechanism((BODY,), contacts=(ClearanceJoint("j", BODY, GROUND, **numbers),)))
    assert "'j'" in str(refused.value)
    assert message in str(refused.value)


BAD_SLOTS = {
    "without play": ({"clearance": 0.0}, (1.0, 0.0), "the pin has no play; use RevoluteTranslational."),
    "no travel": ({"clearance": 0.1, "travel": 0.0}, (1.0, 0.0), "travel = 0 m, but it must be positive and finite"),
    "no direction": ({"clearance": 0.1}, (0.0, 0.0), "its axis_j has length 0"),
}


@pytest.mark.parametrize(("numbers", "axis", "message"), BAD_SLOTS.values(), ids=BAD_SLOTS)
def test_slots_that_cannot_be_are_refused(numbers: dict[str, float], axis: tuple[float, float], message: str) -> None:
    joint = SlotClearanceJoint("j", BODY, GROUND.line((0, 0), axis), **({"travel": 0.1, "pin_radius": 0.01} | numbers))
    with pytest.raises(MechanismError) as refused:
        compile_mechanism(Mechanism((BODY,), contacts=(joint,)))
    assert message in str(refused.value)


def test_what_starts_in_the_wall_is_named_with_its_depth() -> None:
    deep = Body("b", 1.0, 1.0, start=(0.0, -0.0025, 0.0))
    with pytest.raises(MechanismError, match=r"Contact 'j': 'b' reaches 0\.0005 m into 'ground'"):
        Simulation(pin_in_hole(deep))


def test_a_force_holds_the_pin_where_it_presses() -> None:
    """At rest on the wall, and the force is the load."""
    pushed = on_wall(0.0)
    mechanism = replace(pin_in_hole(pushed), forces=(Force("load", pushed, force=(0.0, -2.0)),))
    (shown,) = at(mechanism, (0.5,))
    assert shown["force"] == pytest.approx(0.3 * G + 2.0, rel=1e-12)
    assert shown["sliding_work"] == 0.0
