"""Reactions, input torque and friction against the engine; power, and how evenly a drive works."""

import math
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.path_generator import PathGenerator
from mechanism_fmu.elastodynamics import (
    LinkageError,
    configurations,
    linkage,
    quasi_static,
    torque_fluctuation,
)
from mechanism_fmu.elastodynamics.structure.places import named_place
from mechanism_fmu.kinematics import KinematicMotion, analyse
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Damper,
    Mechanism,
    Member,
    Output,
    Revolute,
    Section,
    Torque,
    Translational,
    lumped_body,
)
from mechanism_fmu.model.curves.motions import harmonic_motion, polynomial_motion
from mechanism_fmu.simulation import Simulation

#: The crank is speeded up from a start that is none of the oracle's.
GENERATOR = PathGenerator(speed=6.0, start=0.7)
DRIVE = AngleDriver("drive", "crank", polynomial_motion(0.7, 6.0, 40.0))
PINS = ("crank_hinge", "crank_pin", "follower_pin", "follower_hinge")
TIMES = np.linspace(0.02, 0.3, 15)
SECTION = Section.rectangle(0.004, 0.012)


def driven(friction=0.0, damping=0.0):
    mechanism = GENERATOR.mechanism()
    joints = tuple(replace(joint, friction_radius=friction) for joint in mechanism.joints[:-1])
    dampers = (
        Damper("hinge_oil", "follower", damping=damping),
        Damper("pin_oil", "follower", "coupler", damping=2 * damping),
    )
    efforts = [f"{pin}.force_{c}" for pin in PINS for c in ("x", "y")] + ["drive.torque"]
    outputs = tuple(Output(f"output{k}", source, "", "1") for k, source in enumerate(efforts))
    return replace(mechanism, joints=(*joints, DRIVE), forces=dampers, outputs=outputs)


def slider_crank(friction, damping):
    """Members only; the drive turns the crank to and fro."""
    crank = lumped_body((Member("crank_bar", "crank", (0.0, 0.0), (0.1, 0.0), SECTION, 2e11, 7850.0),))
    rod = lumped_body((Member("rod_bar", "rod", (0.0, 0.0), (0.3, 0.0), SECTION, 2e11, 7850.0),))
    angle = math.asin(0.1 * math.sin(0.6) / 0.3)
    tip, along = (0.1 * math.cos(0.6), 0.1 * math.sin(0.6)), (1.0, 0.0)
    end = tip[0] + 0.3 * math.cos(angle)
    middle = tip[0] + rod.centre[0] * math.cos(angle), tip[1] - rod.centre[0] * math.sin(angle)
    return Mechanism(
        bodies=(
            Body("crank", crank.mass, crank.inertia, (tip[0] / 2, tip[1] / 2, 0.6)),
            Body("rod", rod.mass, rod.inertia, (*middle, -angle)),
            Body("slider", 0.5, 1e-3, (end, 0.0, 0.0)),
        ),
        joints=(
            Revolute("hinge", "crank", crank.members[0].start, GROUND, (0.0, 0.0)),
            Revolute("pin", "rod", rod.members[0].start, "crank", crank.members[0].end),
            Revolute("wrist", "slider", (0.0, 0.0), "rod", rod.members[0].end),
            Translational("guide", GROUND, (0.0, 0.0), along, "slider", (0.0, 0.0), along, friction),
            AngleDriver("drive", "crank", harmonic_motion(0.6, 1.5, 8.0)),
        ),
        forces=(Damper("oil", "crank", damping=damping),),
        outputs=(Output("torque", "drive.torque", "", "1"), Output("force", "guide.force", "", "1")),
        members=(*crank.members, *rod.members),
    )


def simulated_motion(mechanism, simulation, times):
    """The engine's own motion at `times`, its accelerations among it."""
    count, rows = 3 * len(mechanism.bodies), []
    for time in times:
        simulation.advance(float(time))
        simulation.read_rates()  # leaves the state and its derivative in the work fields
        state, rates = simulation.field("y_at"), simulation.field("dy_at")
        rows.append(np.concatenate([state[: 2 * count], rates[count : 2 * count]]))
    table = np.array(rows).reshape(-1, 3, count)
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    return KinematicMotion(names, np.asarray(times, dtype=float), table[:, 0], table[:, 1], table[:, 2])


def by_the_engine(mechanism, times):
    """Motion, and the outputs, shape (times, outputs)."""
    rates = analyse(mechanism, [0.0]).velocity[0].reshape(-1, 3)
    bodies = tuple(replace(b, start_rate=tuple(r)) for b, r in zip(mechanism.bodies, rates.tolist(), strict=True))
    simulation, rows, motions = Simulation(replace(mechanism, bodies=bodies)), [], []
    for time in times:
        motions.append(simulated_motion(mechanism, simulation, [time]))
        rows.append([*simulation.read().values()])
    tables = ("time", "position", "velocity", "acceleration")
    return replace(motions[0], **{t: np.concatenate([getattr(m, t) for m in motions]) for t in tables}), np.array(rows)


@pytest.mark.parametrize(("friction", "damping"), [(0.0, 0.0), (2e-3, 0.0), (0.0, 0.3), (2e-3, 0.3)])
def test_reactions_of_a_four_bar_are_the_engines(friction, damping):
    mechanism = driven(friction, damping)
    motion, wanted = by_the_engine(mechanism, TIMES)
    cycle = quasi_static(configurations(linkage(mechanism), motion))
    found = np.hstack([cycle.reactions.of(pin) for pin in (*PINS, "drive")])
    np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=1e-6 * np.abs(wanted).max())
    assert np.all(cycle.power.lost > 0.0) == (friction + damping > 0.0)


@pytest.mark.parametrize(("friction", "damping"), [(0.0, 0.0), (0.2, 0.05)])
def test_reactions_of_a_slider_crank_are_the_engines(friction, damping):
    mechanism = slider_crank(friction, damping)
    motion, wanted = by_the_engine(mechanism, np.linspace(0.01, 0.8, 14))
    cycle = quasi_static(configurations(linkage(mechanism), motion))
    found = np.hstack([cycle.reactions.of(joint)[:, :1] for joint in ("drive", "guide")])
    np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=1e-6 * np.abs(wanted).max())


def test_friction_bends_the_members():
    mechanism = driven(2e-3, 0.3)
    motion = analyse(mechanism, TIMES[:3])
    cycle, without = (quasi_static(configurations(linkage(m), motion)) for m in (mechanism, driven()))
    follower = 3
    assert not np.any(without.section_forces[:, follower, 1:])
    place = named_place(cycle.configurations.linkage.freedoms.places, "follower_bar.end")
    pin = cycle.forces[:, place, 2]
    np.testing.assert_allclose(cycle.section_forces[:, follower, 2], pin, rtol=1e-9)
    assert np.all(np.abs(cycle.section_forces[:, follower, 1]) > 0.0)


def test_what_a_free_mechanism_is_driven_by_is_the_reaction_of_its_held_coordinate():
    mechanism = driven()
    free = replace(mechanism, joints=mechanism.joints[:-1], forces=(Torque("motor", "crank", torque=0.8),), outputs=())
    free = replace(free, held=("crank.angle",))
    motion = simulated_motion(free, Simulation(free), TIMES)
    assert np.ptp(motion.of("crank.angle")[1]) > 1.0  # it does not turn steadily
    cycle = quasi_static(configurations(linkage(free), motion))
    np.testing.assert_allclose(cycle.reactions.of("crank.angle")[:, 0], 0.8, rtol=1e-6)
    np.testing.assert_allclose(cycle.power.drives, 0.8 * motion.of("crank.angle")[1], rtol=1e-6)


def test_over_a_cycle_the_drive_works_for_friction_only():
    mechanism = driven(2e-3, 0.3)
    mechanism = replace(
        mechanism, joints=(*mechanism.joints[:-1], AngleDriver("drive", "crank", polynomial_motion(0.7, 6.0)))
    )
    times = np.linspace(0.0, 2 * math.pi / 6.0, 181)
    cycle = quasi_static(configurations(linkage(mechanism), analyse(mechanism, times)))
    power, torque = cycle.power, cycle.reactions.of("drive")[:, 0]
    assert np.abs(power.balance).max() < 1e-12 * np.abs(power.kinetic).max()
    work = np.trapezoid(power.lost, times)
    assert np.trapezoid(power.drives, times) == pytest.approx(work, rel=1e-6)
    found = torque_fluctuation(6.0 * times, torque)
    assert found.mean == pytest.approx(work / (2 * math.pi), rel=1e-6)
    assert (found.least, found.largest) == (torque.min(), torque.max())


def test_fluctuation_of_a_sine():
    angle = np.linspace(0.0, 2 * math.pi, 2001)
    found = torque_fluctuation(angle, 3.0 + 2.0 * np.sin(angle))
    assert found.mean == pytest.approx(3.0, abs=1e-12)
    assert found.energy == pytest.approx(4.0, rel=1e-5)  # the integral of 2 sin over half a turn
    with pytest.raises(LinkageError, match="must increase"):
        torque_fluctuation(angle[::-1], angle)


def test_loads_do_work_on_the_drive():
    mechanism = driven()
    motion = analyse(mechanism, TIMES)
    here = configurations(linkage(mechanism), motion)
    force = np.array([20.0, -7.0, 1.5])
    change = quasi_static(here, {"arm.end": force}).reactions.of("drive") - quasi_static(here).reactions.of("drive")
    velocity = here.pose.velocity_of("coupler", mechanism.members[0].end)
    np.testing.assert_allclose(change[:, 0] * motion.of("crank.angle")[1], -velocity @ force, rtol=1e-9)


def test_a_joint_that_locks_itself_is_refused():
    mechanism = driven(friction=0.5)
    with pytest.raises(LinkageError, match="friction does not settle"):
        quasi_static(configurations(linkage(mechanism), analyse(mechanism, TIMES[:2])))


def test_a_reaction_of_no_joint_is_refused():
    mechanism = driven()
    cycle = quasi_static(configurations(linkage(mechanism), analyse(mechanism, TIMES[:1])))
    with pytest.raises(LinkageError, match="no reaction 'motor'; there are: crank_hinge, "):
        cycle.reactions.of("motor")
