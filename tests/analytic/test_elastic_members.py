"""Elastic members of moving mechanisms against closed forms of beams, in the engine's own motion."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.elastodynamics import LinkageError, configurations, linkage
from mechanism_fmu.kinematics import KinematicMotion
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Force,
    LumpedMass,
    Mechanism,
    MechanismError,
    Member,
    Output,
    PointLineContact,
    Revolute,
    RevoluteTranslational,
    Section,
    Torque,
    Translational,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation

LENGTH, YOUNG, DENSITY, GRAVITY = 0.8, 2.1e11, 7850.0, 9.81
SECTION = Section.rectangle(0.01, 0.02)
BAR_MASS = DENSITY * SECTION.area * LENGTH
STIFFNESS = YOUNG * SECTION.second_moment
MODULUS = 2 * SECTION.second_moment / SECTION.depth
TIP = LumpedMass("tip", "arm", (LENGTH / 2, 0.0), 0.5, 2e-3)
MASS = TIP.mass + BAR_MASS / 2

QUANTITIES = ("axial_force", "start_moment", "end_moment", "stress")
OF_ENDS = ("x", "y", "x_bent", "y_bent", "x_deflection", "y_deflection", "rotation", "deviation")


def read(mechanism, *members, time=0.0):
    """All that can be read of members, by source."""
    sources = [f"{member}.{quantity}" for member in members for quantity in QUANTITIES]
    sources += [f"{member}.{end}.{q}" for member in members for end in ("start", "end") for q in OF_ENDS]
    simulation = Simulation(mechanism([Output(source, source, "") for source in sources]))
    if time > 0.0:
        simulation.advance(time)
    return simulation.read()


def arm(speed, acceleration, angle=0.0, **more):
    """An arm that is turned about the origin."""

    def mechanism(outputs):
        half = LENGTH / 2
        x, y = half * math.cos(angle), half * math.sin(angle)
        return Mechanism(
            bodies=(Body("arm", 3.0, 0.2, (x, y, angle), (-y * speed, x * speed, speed)),),
            joints=(
                Revolute("hinge", "arm", (-half, 0.0), GROUND, (0.0, 0.0)),
                AngleDriver("drive", "arm", polynomial_motion(angle, speed, acceleration / 2)),
            ),
            members=(Member("bar", "arm", (-half, 0.0), (half, 0.0), SECTION, YOUNG, DENSITY),),
            lumped_masses=(TIP,),
            outputs=tuple(outputs),
            **more,
        )

    return mechanism


def test_a_turning_arm_is_stretched_by_the_pull_of_its_tip():
    found = read(arm(20.0, 0.0), "bar")
    pull = MASS * 20.0**2 * LENGTH
    assert found["bar.axial_force"] == pytest.approx(pull, rel=1e-12)
    assert found["bar.stress"] == pytest.approx(pull / SECTION.area, rel=1e-12)
    assert found["bar.end.x_deflection"] == pytest.approx(pull * LENGTH / (YOUNG * SECTION.area), rel=1e-12)
    assert found["bar.end.x_bent"] == pytest.approx(LENGTH + pull * LENGTH / (YOUNG * SECTION.area), rel=1e-12)
    assert found["bar.end.x"] == pytest.approx(LENGTH, rel=1e-15)
    assert found["bar.start.deviation"] == pytest.approx(0.0, abs=1e-18)


@given(st.floats(-math.pi, math.pi), st.floats(-50.0, 50.0))
def test_an_arm_that_is_sped_up_bends_back_as_a_cantilever(angle, acceleration):
    """Tip load -m a and tip moment -J alpha: w = F l^3/3EI + M l^2/2EI, theta = F l^2/2EI + M l/EI."""
    found = read(arm(0.0, acceleration, angle), "bar")
    force, moment = -MASS * acceleration * LENGTH, -TIP.inertia * acceleration
    across = force * LENGTH**3 / (3 * STIFFNESS) + moment * LENGTH**2 / (2 * STIFFNESS)
    turned = force * LENGTH**2 / (2 * STIFFNESS) + moment * LENGTH / STIFFNESS
    near = {"rel": 1e-10, "abs": 1e-15}
    assert found["bar.end.rotation"] == pytest.approx(turned, **near)
    assert found["bar.end.deviation"] == pytest.approx(abs(across), **near)
    assert found["bar.end.x_deflection"] == pytest.approx(-across * math.sin(angle), **near)
    assert found["bar.end.y_deflection"] == pytest.approx(across * math.cos(angle), **near)
    assert found["bar.start_moment"] == pytest.approx(force * LENGTH + moment, rel=1e-10, abs=1e-9)
    assert found["bar.end_moment"] == pytest.approx(moment, rel=1e-10, abs=1e-9)
    assert found["bar.stress"] == pytest.approx(abs(force * LENGTH + moment) / MODULUS, rel=1e-10, abs=1e-3)


def test_weight_is_shared_among_the_lumps():
    found = read(arm(0.0, 0.0, forces=(Force("weight", "arm", (0.0, -3.0 * GRAVITY)),)), "bar")
    at_tip = 3.0 * GRAVITY * MASS / (TIP.mass + BAR_MASS)
    assert found["bar.end.y_deflection"] == pytest.approx(-at_tip * LENGTH**3 / (3 * STIFFNESS), rel=1e-11)


def crank_and_slider(torque=0.0, push=0.0, friction=0.0, pin=0.0, speed=0.0):
    """A crank upright, with so much inertia that it keeps its speed, and a light rod to a rigid slider."""

    def mechanism(outputs):
        rod, half = 1.0, LENGTH / 2
        along = math.sqrt(rod**2 - LENGTH**2)
        angle = -math.acos(along / rod)
        return Mechanism(
            bodies=(
                Body("arm", 1e-6, 1e6, (0.0, half, math.pi / 2), (-half * speed, 0.0, speed)),
                Body("rod", 1e-6, 1e-6, (along / 2, half, angle)),
                Body("slider", 1e-6, 1.0, (along, 0.0, 0.0)),
            ),
            joints=(
                Revolute("hinge", "arm", (-half, 0.0), GROUND, (0.0, 0.0)),
                Revolute("pin", "rod", (-rod / 2, 0.0), "arm", (half, 0.0), pin),
                Revolute("head", "slider", (0.0, 0.0), "rod", (rod / 2, 0.0)),
                Translational("guide", "slider", (0.0, 0.0), (1.0, 0.0), GROUND, (0.0, 0.0), (1.0, 0.0), friction),
            ),
            forces=(Force("push", "slider", (push, 0.0)), Torque("twist", "rod", "arm", torque)),
            members=(
                Member("bar", "arm", (-half, 0.0), (half, 0.0), SECTION, YOUNG, 0.0),
                Member("link", "rod", (-rod / 2, 0.0), (rod / 2, 0.0), SECTION, YOUNG, 0.0),
            ),
            held=("arm.angle",),
            outputs=tuple(outputs),
        )

    return mechanism


def test_a_torque_between_two_links_bends_both_at_their_pin():
    found = read(crank_and_slider(torque=5.0), "bar", "link")
    # the rod's moment at the pin is held by a force across it at the slider, whose guide takes it but for inertia
    assert found["link.start_moment"] == pytest.approx(-5.0, rel=1e-9)
    assert found["link.end_moment"] == pytest.approx(0.0, abs=1e-12)
    assert found["bar.end_moment"] == pytest.approx(-5.0, rel=1e-9)


def test_friction_loads_the_members_where_it_acts():
    """The pin's torque turns both links, the guide's force comes through the rod: as the joints of the motion say."""
    radius = 2e-3
    mechanism = crank_and_slider(push=-300.0, friction=0.3, pin=radius, speed=5.0)
    joints = [Output(f"{j}_{axis}", f"{j}.force_{axis}", "") for j in ("pin", "head") for axis in "xy"]
    members = [Output(source, source, "") for source in ("link.start_moment", "bar.end_moment", "link.axial_force")]
    found = Simulation(mechanism([*joints, *members])).read()
    torque = radius * math.hypot(found["pin_x"], found["pin_y"])
    assert torque > 0.5
    # the rod turns clockwise against the crank: friction turns it the other way, and bends its start to the right
    assert found["link.start_moment"] == pytest.approx(-torque, rel=1e-6)
    assert found["bar.end_moment"] == pytest.approx(-torque, rel=1e-6)
    along = math.sqrt(1.0 - LENGTH**2), -LENGTH
    pull = -(found["head_x"] * along[0] + found["head_y"] * along[1])  # of the slider on the rod's end
    assert found["link.axial_force"] == pytest.approx(pull, rel=1e-6)
    assert abs(pull) > 100.0


def shallow(slope):
    """Two bars between fixed hinges, which sag at the pin in their middle by an angle; half of a weight hangs there."""
    x, y = math.cos(slope) / 2, -math.sin(slope) / 2

    def mechanism(outputs):
        members = tuple(Member(f"bar{k}", f"arm{k}", (-0.5, 0.0), (0.5, 0.0), SECTION, YOUNG, DENSITY) for k in (0, 1))
        return Mechanism(
            bodies=(Body("arm0", 1.0, 0.1, (x, y, -slope)), Body("arm1", 1.0, 0.1, (3 * x, y, slope))),
            joints=(
                Revolute("left", "arm0", (-0.5, 0.0), GROUND, (0.0, 0.0)),
                Revolute("middle", "arm0", (0.5, 0.0), "arm1", (-0.5, 0.0)),
                Revolute("right", "arm1", (0.5, 0.0), GROUND, (4 * x, 0.0)),
            ),
            forces=(Force("weight", "arm0", (0.0, -10.0)),),
            members=members,
            outputs=tuple(outputs),
        )

    return mechanism


def test_two_shallow_bars_sink_with_the_square_of_their_slope():
    """N = F / 2 sin(slope) in each, and the pin sinks by N l / EA sin(slope); F is half of the weight."""
    slope = 1e-3
    found = read(shallow(slope), "bar0", "bar1")
    pull = 5.0 / (2 * math.sin(slope))
    assert found["bar0.axial_force"] == pytest.approx(pull, rel=1e-8)
    sunk = pull / (YOUNG * SECTION.area * math.sin(slope))
    assert found["bar0.end.y_deflection"] == pytest.approx(-sunk, rel=1e-8)


def test_at_a_toggle_what_gives_way_is_huge_and_finite():
    """Two bars in line hold nothing across them, until they are stretched: no number may pass for a deflection."""
    found = read(shallow(0.0), "bar0", "bar1")
    assert all(map(math.isfinite, found.values()))
    assert found["bar0.stress"] > 1e6 * YOUNG
    assert found["bar0.end.deviation"] > 1e6
    flat = shallow(0.0)([])
    here = np.array([[value for body in flat.bodies for value in body.start]])
    names = tuple(f"{body.name}.{c}" for body in flat.bodies for c in ("x", "y", "angle"))
    still = KinematicMotion(names, np.zeros(1), here, np.zeros_like(here), np.zeros_like(here))
    with pytest.raises(LinkageError, match="bar0"):
        _ = configurations(linkage(flat), still).transfer


def test_contacts_and_redundant_joints_are_refused_with_the_reason():
    contact = PointLineContact("stop", "arm", (LENGTH / 2, 0.0), GROUND, (0.0, -1.0), (0.0, 1.0))
    with pytest.raises(MechanismError, match="contact 'stop' opens and closes"):
        read(arm(0.0, 0.0, contacts=(contact,)), "bar")

    def twice(outputs):
        once = arm(0.0, 0.0)(outputs)
        joints = (*once.joints, RevoluteTranslational("more", "arm", (LENGTH / 2, 0.0), (1.0, 0.0), GROUND, (0.0, 0.0)))
        return Mechanism(once.bodies, joints, members=once.members, outputs=once.outputs)

    with pytest.raises(MechanismError, match=r"6 displacements, .* 1 members, 4 rows of joints .* Take away joints"):
        read(twice, "bar")

    def free(outputs):
        once = arm(0.0, 0.0)(outputs)
        return Mechanism(once.bodies, once.joints[:1], members=once.members, outputs=once.outputs)

    with pytest.raises(MechanismError, match="Hold a coordinate"):
        read(free, "bar")


def test_a_joint_beside_the_ends_of_members_is_refused_by_name():
    def beside(outputs):
        once = arm(0.0, 0.0)(outputs)
        member = Member("bar", "arm", (-0.3, 0.0), (LENGTH / 2, 0.0), SECTION, YOUNG, 0.0)
        return Mechanism(once.bodies, once.joints, members=(member,), outputs=once.outputs)

    with pytest.raises(MechanismError, match=r"Revolute 'hinge' stands at \(-0.4, 0.0\) of body 'arm'"):
        read(beside, "bar")


def test_what_else_is_read_is_the_same_to_the_bit():
    angle = [
        Output("angle", "arm.angle", ""),
        Output("speed", "arm.speed", ""),
        Output("kinetic", "energy.kinetic", ""),
    ]
    elastic = [Output("stress", "bar.stress", ""), Output("off", "bar.end.deviation", "")]
    runs = []
    for outputs in (angle, [*angle, *elastic]):
        simulation = Simulation(arm(3.0, -5.0)(outputs))
        found = []
        for step in range(1, 20):
            simulation.advance(0.05 * step)
            values = simulation.read()
            found.append([values[output.name] for output in angle])
        runs.append(found)
    assert runs[0] == runs[1]
