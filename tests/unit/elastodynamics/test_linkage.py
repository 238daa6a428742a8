"""Which coordinates members have, what holds a mechanism as a structure, and what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.path_generator import PathGenerator
from mechanism_fmu.elastodynamics import (
    LinkageError,
    configurations,
    linkage,
    mass_matrix,
    quasi_static,
    unlike_bodies,
)
from mechanism_fmu.kinematics import KinematicMotion, analyse
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Damper,
    Gears,
    LumpedMass,
    Mechanism,
    Member,
    Revolute,
    Section,
    XDriver,
)
from mechanism_fmu.model.curves.motions import polynomial_motion

MECHANISM = PathGenerator().mechanism()
SECTION = Section.rectangle(0.01, 0.02)
TIMES = np.linspace(0.0, 0.11, 9)


def still(mechanism):
    """The mechanism at rest where its bodies start."""
    position = np.array([[c for body in mechanism.bodies for c in body.start]])
    names = tuple(f"{b.name}.{c}" for b in mechanism.bodies for c in ("x", "y", "angle"))
    return KinematicMotion(names, np.zeros(1), position, 0 * position, 0 * position)


def bar(name, body, length=1.0):
    return Member(name, body, (0.0, 0.0), (length, 0.0), SECTION, 2e11, 7850.0)


def arm(**changes):
    """A bar on a hinge at the origin."""
    arm = Mechanism(
        bodies=(Body("arm", 1.0, 1.0),),
        joints=(Revolute("hinge", "arm", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        held=("arm.angle",),
        members=(bar("bar", "arm"),),
    )
    return replace(arm, **changes)


def coordinates(mechanism, **given):
    return [name.partition(".")[::2] for name in linkage(mechanism, **given).coordinates]


def test_the_coordinates_of_case_1_are_the_papers():
    found = coordinates(MECHANISM)
    assert [kind for name, kind in found if name == "arm"] == ["axial", "transverse", "rotation"]
    assert [kind for name, kind in found if name == "crank_bar"] == ["axial", "transverse"]
    assert [kind for name, kind in found if name == "coupler_bar"] == ["axial", "rotation"]
    assert [kind for name, kind in found if name == "follower_bar"] == ["axial"]


def test_a_moment_on_a_pin_makes_a_rotation_known():
    assert len(coordinates(MECHANISM, loaded=("follower_bar.end",))) == 9
    assert len(coordinates(MECHANISM, loaded=("crank_bar.end", "follower_bar.start"))) == 10


def test_friction_and_inertia_at_a_pin_make_rotations_known():
    joints = tuple(replace(j, friction_radius=1e-3) if j.name == "follower_pin" else j for j in MECHANISM.joints)
    assert len(coordinates(replace(MECHANISM, joints=joints))) == 10  # of follower and coupler
    damper = Damper("damper", "follower", damping=0.1)
    assert len(coordinates(replace(MECHANISM, forces=(damper,)))) == 9  # of the follower at its hinge
    wheel = LumpedMass("wheel", "follower", MECHANISM.members[3].end, 0.1, 1e-4)
    assert len(coordinates(replace(MECHANISM, lumped_masses=(wheel,)))) == 9


def test_drivers_hold_the_mechanism_and_without_them_its_held_coordinates():
    held = replace(MECHANISM, joints=MECHANISM.joints[:-1], held=("crank.angle",))
    both = replace(MECHANISM, held=("follower.angle",))
    one = configurations(linkage(MECHANISM), still(MECHANISM)).transfer
    for other in (held, both):
        np.testing.assert_array_equal(configurations(linkage(other), still(other)).transfer, one)
    other = configurations(linkage(replace(held, held=("follower.angle",))), still(held))
    assert "follower_bar.transverse" in other.linkage.coordinates
    with pytest.raises(LinkageError, match=r"'coupler\.angle' turns 'coupler' against 'ground', which have 0 pins"):
        linkage(replace(held, held=("coupler.angle",)))


def test_all_configurations_at_once_are_each_of_them():
    motion = analyse(MECHANISM, TIMES)
    structure = linkage(MECHANISM)
    together = configurations(structure, motion)
    cycle = quasi_static(together)
    for k in (0, 4, 8):
        parts = (table[k : k + 1] for table in (motion.time, motion.position, motion.velocity, motion.acceleration))
        alone = configurations(structure, KinematicMotion(motion.coordinates, *parts))
        np.testing.assert_allclose(together.transfer[k], alone.transfer[0], rtol=1e-13, atol=1e-13)
        np.testing.assert_allclose(together.stiffness[k], alone.stiffness[0], rtol=1e-12)
        np.testing.assert_allclose(cycle.stress[k], quasi_static(alone).stress[0], rtol=1e-12)


def test_forces_do_the_work_that_deformations_store():
    here = configurations(linkage(MECHANISM), analyse(MECHANISM, TIMES))
    np.testing.assert_allclose(
        np.swapaxes(here.compatibility, 1, 2) @ here.transfer, np.broadcast_to(np.eye(8), (9, 8, 8)), atol=1e-13
    )
    cycle = quasi_static(here)
    loads = np.linalg.solve(here.system_flexibility, cycle.displacement[:, :, None])[:, :, 0]
    outside = np.einsum("tk,tk->t", loads, cycle.displacement)
    inside = np.einsum("tn,nk,tk->t", cycle.element_forces, here.linkage.flexibility, cycle.element_forces)
    np.testing.assert_allclose(outside, inside, rtol=1e-9)
    np.testing.assert_allclose(
        here.stiffness @ here.system_flexibility, np.broadcast_to(np.eye(8), (9, 8, 8)), atol=1e-9
    )


def test_masses_are_those_of_members_and_disks():
    here = configurations(linkage(MECHANISM), still(MECHANISM))
    matrix = mass_matrix(here)[0]
    x = np.array([name.endswith(".x") for name in here.coordinates], dtype=float)
    fixed = sum(
        member.density * member.section.area * math.dist(member.start, member.end) / 2
        for member in (MECHANISM.members[1], MECHANISM.members[3])
    )
    assert x @ matrix @ x == pytest.approx(sum(body.mass for body in MECHANISM.bodies) - fixed, rel=1e-14)
    assert np.count_nonzero(matrix - np.diag(np.diag(matrix))) == 0


@pytest.mark.parametrize("reverse", [False, True])
def test_a_cantilever_bends_as_tables_say(reverse):
    member = bar("bar", "arm", 2.0)
    if reverse:
        member = replace(member, start=member.end, end=member.start)
    mechanism = arm(members=(member,))
    tip = "bar.start" if reverse else "bar.end"
    cycle = quasi_static(configurations(linkage(mechanism), still(mechanism)), {tip: (5.0, -30.0, 7.0)})
    bending = 2e11 * SECTION.second_moment
    x, y, rotation = cycle.deflection(tip)[0]
    assert x == pytest.approx(5.0 * 2.0 / (2e11 * SECTION.area), rel=1e-12)
    assert y == pytest.approx((-30.0 * 8.0 / 3 + 7.0 * 4.0 / 2) / bending, rel=1e-12)
    assert rotation == pytest.approx((-30.0 * 4.0 / 2 + 7.0 * 2.0) / bending, rel=1e-12)
    root = abs(-30.0 * 2.0 + 7.0) * 0.01 / SECTION.second_moment
    assert cycle.stress[0, 0] == pytest.approx(5.0 / SECTION.area + root, rel=1e-12)
    moment = cycle.section_forces[0, 0, 2 if reverse else 1]
    assert moment == pytest.approx((1 if reverse else -1) * (30.0 * 2.0 - 7.0), rel=1e-12)
    assert cycle.reactions.of("arm.angle")[0, 0] == pytest.approx(30.0 * 2.0 - 7.0, rel=1e-12)


REFUSALS = {
    "nothing bends": (arm(members=()), "no members"),
    "nothing holds it": (arm(held=()), "can move although driven or held coordinates stand still"),
    "two pins for one angle": (
        arm(joints=(*arm().joints, Revolute("other", "arm", (1.0, 0.0), GROUND, (1.0, 0.0)))),
        "2 pins in common",
    ),
    "a joint in the middle": (
        arm(joints=(*arm().joints, XDriver("push", "arm", (0.5, 0.0), polynomial_motion(0.5)))),
        "XDriver 'push' is attached to 'arm' at (0.5, 0) m, where no member of it ends",
    ),
    "a disk in the middle": (arm(lumped_masses=(LumpedMass("disk", "arm", (0.5, 0.0), 1.0),)), "LumpedMass 'disk'"),
    "its centre of mass is held": (arm(held=("arm.x",)), "'arm.x' is the centre of mass of a body that bends"),
    "an unknown joint": (
        arm(
            bodies=(*arm().bodies, Body("wheel", 1.0, 1.0)),
            joints=(
                *arm().joints,
                Gears("gears", "arm", "wheel", radius_i=0.1, angle_i=0.0, radius_j=0.1, angle_j=0.0),
            ),
        ),
        "Gears 'gears': the flexibility approach knows",
    ),
    "a damper without a pin": (
        arm(bodies=(*arm().bodies, Body("wheel", 1.0, 1.0)), forces=(Damper("drag", "arm", "wheel", 0.1),)),
        "Damper 'drag' turns 'wheel' against 'arm', which have 0 pins",
    ),
    "a body that is held by nothing": (
        arm(bodies=(*arm().bodies, Body("loose", 1.0, 1.0)), members=(bar("bar", "arm"), bar("rod", "loose"))),
        "rod.",
    ),
    "a short member": (
        arm(members=(bar("bar", "arm"), replace(bar("stub", "arm"), start=(1.0, 0.0), end=(1.0, 1e-12)))),
        "'stub' is too short",
    ),
}


@pytest.mark.parametrize(("mechanism", "said"), REFUSALS.values(), ids=REFUSALS)
def test_what_is_no_structure_is_refused_with_the_reason(mechanism, said):
    with pytest.raises(LinkageError) as error:
        _ = configurations(linkage(mechanism), still(mechanism)).transfer
    assert said in str(error.value)


def test_a_toggle_position_is_refused_at_its_time():
    mechanism = Mechanism(
        bodies=tuple(Body(n, 1.0, 1.0, (x, 0.0, 0.0)) for n, x in (("crank", 0.0), ("rod", 1.0), ("rocker", 2.0))),
        joints=(
            Revolute("a", "crank", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("b", "rod", (0.0, 0.0), "crank", (1.0, 0.0)),
            Revolute("c", "rocker", (0.0, 0.0), "rod", (1.0, 0.0)),
            Revolute("d", "rocker", (1.0, 0.0), GROUND, (3.0, 0.0)),
        ),
        held=("crank.angle",),
        members=(bar("one", "crank"), bar("two", "rod"), bar("three", "rocker")),
    )
    with pytest.raises(LinkageError, match=r"At t = 0 s members hold nothing: two\.end\.y can move"):
        _ = configurations(linkage(mechanism), still(mechanism)).transfer
    with pytest.raises(LinkageError, match="At t = 0 s the rigid mechanism can move"):
        quasi_static(configurations(linkage(mechanism), still(mechanism)))


@pytest.mark.parametrize(
    ("loads", "said"),
    [({"bar.middle": (1, 0, 0)}, "no place 'bar.middle'; there are bar.start, bar.end"), ({"b": 0}, "no place 'b'")],
)
def test_loads_on_no_place_are_refused(loads, said):
    with pytest.raises(LinkageError, match=said):
        quasi_static(configurations(linkage(arm()), still(arm())), loads)


def test_a_moment_on_a_mere_pin_is_refused():
    here = configurations(linkage(MECHANISM), still(MECHANISM))
    with pytest.raises(LinkageError, match=r"A moment acts at 'follower_bar\.end', where there is only a pin"):
        quasi_static(here, {"follower_bar.end": (0.0, 0.0, 1.0)})


def test_another_mechanisms_motion_is_refused():
    with pytest.raises(LinkageError, match=r"the mechanism has arm\.x"):
        configurations(linkage(arm()), still(MECHANISM))
    motion = still(arm())
    with pytest.raises(LinkageError, match="not finite"):
        configurations(linkage(arm()), replace(motion, position=motion.position * math.nan))


def test_rigid_bodies_that_are_held_twice_are_refused():
    joints = (*arm().joints, Revolute("hub", "wheel", (0.0, 0.0), GROUND, (3.0, 0.0)))
    twice = (
        AngleDriver("turn", "wheel", polynomial_motion(0.0)),
        XDriver("push", "wheel", (0.0, 1.0), polynomial_motion(3.0)),
    )
    angle = AngleDriver("drive", "arm", polynomial_motion(0.0))
    mechanism = arm(bodies=(*arm().bodies, Body("wheel", 1.0, 1.0, (3.0, 0.0, 0.0))), joints=(*joints, angle, *twice))
    with pytest.raises(LinkageError, match="say the same of rigid parts"):
        configurations(linkage(mechanism), still(mechanism))


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (Body("arm", 1.57, 0.3925, (0.5, 0.0, 0.0)), None),
        (Body("arm", 1.57 * 1.005, 0.3925, (0.5, 0.0, 0.0)), None),
        (
            Body("arm", 1.6, 0.3925, (0.5, 0.0, 0.0)),
            "1.6 kg and 0.3925 kg.m2, its members and lumped masses have 1.57 kg",
        ),
        (Body("arm", 1.57, 1.57 / 12, (0.5, 0.0, 0.0)), "0.3925 kg.m2"),  # mass spread along the bar
    ],
)
def test_a_body_whose_mass_its_members_do_not_have_is_named(body, said):
    """A steel bar of 1 m, 10 x 20 mm: 1.57 kg, half of it 0.5 m from the centre at either end."""
    member = Member("bar", "arm", (-0.5, 0.0), (0.5, 0.0), SECTION, 2e11, 7850.0)
    found = unlike_bodies(arm(bodies=(body,), members=(member,)))
    assert (said in found[0]) if said else found == ()


def test_a_centre_beside_that_of_the_members_is_named():
    assert (
        "with their centre 500 mm beside"
        in unlike_bodies(arm(bodies=(Body("arm", 1.57, 0.785),), members=(bar("bar", "arm"),)))[0]
    )
    assert unlike_bodies(arm(members=(), held=())) == ()  # a rigid body has its own mass
