"""A bar on a hinge that bends under its own inertia: closed forms, and the ratchet's pawl seen from its other end."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

import models
from mechanism_fmu.model import (
    GROUND,
    Body,
    Force,
    LumpedMass,
    Mechanism,
    MechanismError,
    Member,
    Output,
    PointLineContact,
    Revolute,
    Section,
    SpringDamper,
    Torque,
    hinged_beam_outputs,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.simulation import Simulation

LENGTH, MASS, YOUNG, GRAVITY = 0.6, 2.0, 2.1e11, 9.81
UNIFORM = MASS * LENGTH**2 / 12
SECTION = Section.rectangle(0.01, 0.03)
STIFFNESS, MODULUS = YOUNG * 0.01 * 0.03**3 / 12, 0.01 * 0.03**2 / 6


def bar(angle=0.0, speed=0.0, torque=0.0, weight=0.0, inertia=UNIFORM, centre=LENGTH / 2, swapped=False, **more):
    """A bar that begins to turn about the origin; its outputs."""
    x, y = centre * math.cos(angle), centre * math.sin(angle)
    hinge = ("rod", (-centre, 0.0), GROUND, (0.0, 0.0))
    return Mechanism(
        bodies=(Body("rod", MASS, inertia, (x, y, angle), (-y * speed, x * speed, speed)),),
        joints=(Revolute("hinge", *(hinge[2:] + hinge[:2] if swapped else hinge)),),
        forces=(Torque("drive", "rod", torque=torque), Force("weight", "rod", (0.0, -weight))),
        members=(Member("beam", "rod", (-centre, 0.0), (LENGTH - centre, 0.0), SECTION, YOUNG, 7850.0),),
        outputs=hinged_beam_outputs("rod", "beam", "rod", ()),
        **more,
    )


def read(mechanism):
    values = Simulation(mechanism).read()
    return values["rod_tip_deflection"], values["rod_bending_stress"]


@pytest.mark.parametrize("swapped", [False, True])
def test_a_falling_chimney_is_bent_most_at_a_third_of_its_height(swapped):
    """M = m g x (l - x)^2 / 4 l^2 for a bar that begins to fall out of the horizontal: m g l / 27 at l/3."""
    deflection, stress = read(bar(weight=MASS * GRAVITY, swapped=swapped))
    assert stress == pytest.approx(MASS * GRAVITY * LENGTH / 27 / MODULUS, rel=1e-12)
    assert deflection == pytest.approx(MASS * GRAVITY * LENGTH**3 / (80 * STIFFNESS), rel=1e-12)


def test_a_torque_at_the_hinge_bends_a_free_bar_back():
    """Alpha = 3 T / m l^2 and M = -T (1 - 3 x / 2 l + x^3 / 2 l^3); the tip stays behind by 11 T l^2 / 40 EI."""
    deflection, stress = read(bar(angle=0.7, speed=3.0, torque=5.0))
    assert stress == pytest.approx(5.0 / MODULUS, rel=1e-12)
    assert deflection == pytest.approx(-11 / 40 * 5.0 * LENGTH**2 / STIFFNESS, rel=1e-12)


def test_a_bar_that_rests_on_a_stop_is_a_cantilever_under_the_stops_force():
    """F = T / l at the tip: w = -F l^3 / 3EI, sigma = T / W."""
    stop = PointLineContact("stop", "rod", (LENGTH / 2, 0.0), GROUND, (0.0, 0.0), (0.0, -1.0), closed=True)
    deflection, stress = read(bar(torque=4.0, contacts=(stop,)))
    assert stress == pytest.approx(4.0 / MODULUS, rel=1e-12)
    assert deflection == pytest.approx(-(4.0 / LENGTH) * LENGTH**3 / (3 * STIFFNESS), rel=1e-12)


@given(st.floats(0.2, 0.8), st.floats(0.3, 1.5), st.floats(-9.0, 9.0), st.floats(-20.0, 20.0), st.floats(-3.0, 3.0))
def test_the_moment_is_that_of_the_bars_masses_beyond(share, spread, torque, weight, angle):
    """A uniform bar and two point masses that have mass, centre and inertia; moments of what lies beyond, summed."""
    centre, inertia = share * LENGTH, spread * UNIFORM
    found = read(bar(angle, 2.0, torque, weight, inertia, centre))
    per_length, at_hinge, at_tip = np.linalg.solve(
        [
            [LENGTH, 1.0, 1.0],
            [LENGTH**2 / 2, 0.0, LENGTH],
            [LENGTH**3 / 3, 0.0, LENGTH**2],
        ],
        [MASS, MASS * centre, inertia + MASS * centre**2],
    )
    turning = (torque - weight * math.cos(angle) * centre) / (inertia + MASS * centre**2)
    pull = weight / MASS * math.cos(angle)  # across the bar, per mass

    def load(x):  # across the bar, per mass
        return -(turning * x + pull)

    x, step = np.linspace(0.0, LENGTH, 2001, retstep=True)
    beyond = LENGTH - x
    # of a straight load between x and the tip, and of the point mass on the tip
    moment = per_length * beyond**2 * (load(x) / 2 + (load(LENGTH) - load(x)) / 3) + at_tip * load(LENGTH) * beyond
    weights = np.full(len(x), 2.0)
    weights[1::2], weights[0], weights[-1] = 4.0, 1.0, 1.0
    deflection = (weights * moment * beyond).sum() * step / 3 / STIFFNESS  # Simpson's rule
    assert found[0] == pytest.approx(deflection, rel=1e-8, abs=1e-15)
    assert found[1] == pytest.approx(np.abs(moment).max() / MODULUS, rel=1e-5, abs=1e-6)
    assert at_hinge + at_tip + per_length * LENGTH == pytest.approx(MASS)


def test_only_a_bar_on_one_hinge_has_a_tip():
    once = bar()
    beside = Member("beam", "rod", (0.0, 0.0), (LENGTH / 2, 0.0), SECTION, YOUNG, 7850.0)
    more = Revolute("tip", "rod", (LENGTH / 2, 0.0), GROUND, (LENGTH, 0.0))
    outputs = (Output("d", "beam.tip_deflection", ""),)
    for changed in ({"members": (beside,)}, {"joints": (*once.joints, more)}):
        parts = {"bodies": once.bodies, "joints": once.joints, "members": once.members} | changed
        with pytest.raises(
            MechanismError, match=r"Member 'beam': tip_deflection and bending_stress .* on one revolute"
        ):
            Simulation(Mechanism(outputs=outputs, **parts))


def test_what_pushes_or_weighs_beside_the_tip_is_refused():
    """Moments about the tip say nothing of a force in the middle: it would come out as a couple at the hinge."""
    middle = PointLineContact("stop", "rod", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, -1.0), closed=True)
    surface = PointLineContact("rest", GROUND, (LENGTH, 0.0), "rod", (0.0, 0.0), (0.0, 1.0))
    for contact, said in ((middle, "PointLineContact 'stop'"), (surface, "PointLineContact 'rest'")):
        with pytest.raises(MechanismError, match=f"{said} pushes body 'rod' beside the end of member 'beam'"):
            compile_mechanism(bar(contacts=(contact,)))
    with pytest.raises(MechanismError, match=r"LumpedMass 'lump' stands beside the ends of member 'beam'"):
        compile_mechanism(bar(lumped_masses=(LumpedMass("lump", "rod", (0.0, 0.0), 0.1),)))
    strut = SpringDamper("strut", "rod", (0.0, 0.0), GROUND, (0.0, 1.0))
    with pytest.raises(MechanismError, match=r"SpringDamper 'strut' acts at a point of body 'rod'"):
        compile_mechanism(replace(bar(), forces=(strut,)))
    at_tip = LumpedMass("tip", "rod", (LENGTH / 2, 0.0), 0.1)
    assert compile_mechanism(bar(lumped_masses=(at_tip,))).beam_body.tolist() == [0]


def pawl_from_the_tip(values, parameters, rates):
    """Moment of the pawl by the forces of slope and face on its tip, and the inertia between: M(s), s from the tip."""
    gamma, psi = values["pawl_angle"], values["wheel_angle"]
    b, mass, inertia = (parameters[f"pawl_{name}"] for name in ("length", "mass", "inertia"))
    lean = math.pi - parameters["tooth_slope_angle"] - values["tooth_apex_angle"] - values["tooth_pitch"]
    normals = {
        "slope_force": psi + parameters["tooth_slope_angle"] - math.pi / 2,
        "contact_force": psi - math.pi / 2 - lean,
    }
    push = sum(values[name] * math.sin(angle - gamma) for name, angle in normals.items())
    a, phi, speed = parameters["crank_length"], values["crank_angle"], values["crank_speed"]
    # acceleration of the pin across the pawl: a phi'' across the crank, -a phi'^2 along it
    pin = a * rates["crank_speed"] * math.cos(phi - gamma) - a * speed**2 * math.sin(phi - gamma)
    ends = 3 * (inertia - mass * b**2 / 12) / b**2
    per_length, at_end = (mass - 2 * ends) / b, ends

    def moment(s):
        tip, here = pin + rates["pawl_speed"] * b, pin + rates["pawl_speed"] * (b - s)
        return (push - at_end * tip) * s - per_length * s**2 * (here / 2 + (tip - here) / 3)

    return moment


@pytest.mark.parametrize("time", [0.0, 0.5, 0.93, 0.95, 3.0])
def test_the_ratchets_pawl_from_its_tip(time):
    """Sliding on the slope, and standing at the root: from the contact forces instead of the hinge's."""
    model = models.load("ratchet").MODEL
    parameters = {p.name: p.start for p in model.parameters} | {"pawl_spring_torque": 2e-3}
    simulation = Simulation(model.build(model.values(pawl_spring_torque=2e-3)))
    if time:
        simulation.advance(time)
    values, rates = simulation.read(), simulation.read_rates()
    moment = pawl_from_the_tip(values, parameters, rates)
    b, width, depth = (parameters[f"pawl_{name}"] for name in ("length", "width", "depth"))
    s = np.linspace(0.0, b, 4001)
    found = np.array([moment(x) for x in s])
    weights = np.full(len(s), 2.0)
    weights[1::2], weights[0], weights[-1] = 4.0, 1.0, 1.0
    stiffness = parameters["elastic_modulus"] * width * depth**3 / 12
    deflection = (weights * found * s).sum() * b / 4000 / 3 / stiffness
    assert values["pawl_tip_deflection"] == pytest.approx(deflection, rel=1e-6, abs=1e-16)
    assert values["pawl_bending_stress"] == pytest.approx(np.abs(found).max() * 6 / (width * depth**2), rel=1e-6)
    assert np.isnan(rates["pawl_tip_deflection"])
