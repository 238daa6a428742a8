"""Compliance of the ratchet's links: against the flexibility approach, beams under impact, and in a run's report."""

import math

import numpy as np
import pandas as pd
import pytest

from harness.analysis.compliance import compliance_of, compliance_units, compliance_values
from harness.report.impact_sections import compliance_section
from mechanism_fmu.elastodynamics import configurations, linkage
from mechanism_fmu.kinematics import KinematicMotion
from mechanism_fmu.model import GROUND, Body, Mechanism, Member, Revolute, Section
from mechanism_fmu.stress.links import DEFLECTION, ENERGY, HINGE, LARGEST_MOMENT
from tests.declared import RATCHET

CHAIN = RATCHET.chain
assert CHAIN is not None
UNITS = compliance_units(CHAIN)

VALUES = {
    "crank_length": 0.11,
    "crank_width": 5e-3,
    "crank_depth": 20e-3,
    "pawl_length": 0.1,
    "pawl_width": 6e-3,
    "pawl_depth": 15e-3,
    "wheel_inner_radius": 0.1,
    "tooth_pitch": 2 * math.pi / 10,
    "tooth_slope_angle": math.pi / 2,
    "tooth_apex_angle": 0.6,
    "restitution": 0.2,
}
HINGE_DISTANCE, PHI = 0.13, math.radians(80)
#: Where pin and root are, and the angles that follow.
PIN = (HINGE_DISTANCE + 0.11 * math.cos(PHI), 0.11 * math.sin(PHI))
PSI = math.radians(70)
ROOT = (0.1 * math.cos(PSI), 0.1 * math.sin(PSI))
GAMMA = math.atan2(ROOT[1] - PIN[1], ROOT[0] - PIN[0])
#: A pawl that just reaches the root.
PAWL = math.hypot(ROOT[0] - PIN[0], ROOT[1] - PIN[1])
VALUES["pawl_length"] = PAWL
#: Of steel bars: 3 E I / a^3 across the crank, E A / b along the pawl.
VALUES["crank_stiffness"] = 3 * 2.06e11 * (5e-3 * 20e-3**3 / 12) / 0.11**3
VALUES["pawl_stiffness"] = 2.06e11 * (6e-3 * 15e-3) / PAWL
NO_IMPACTS = pd.DataFrame(columns=["time", "closing_speed", "impulse", "tooth", "contact"])


def normals(tooth):
    """Of slope and face in the global frame; the root's polar angle is that of the struck tooth."""
    lean = math.pi - VALUES["tooth_slope_angle"] - VALUES["tooth_apex_angle"] - VALUES["tooth_pitch"]
    slope = np.array([math.sin(VALUES["tooth_slope_angle"]), -math.cos(VALUES["tooth_slope_angle"])])
    face = np.array([-math.sin(lean), -math.cos(lean)])
    c, s = math.cos(PSI), math.sin(PSI)
    turn = np.array([[c, -s], [s, c]])
    return turn @ slope, turn @ face


def results(tooth, force):
    """One communication point at which the tip, at the root of a tooth, is pushed by a force along the pawl."""
    slope, face = np.linalg.solve(np.column_stack(normals(tooth)), force * np.array([math.cos(GAMMA), math.sin(GAMMA)]))
    row = dict.fromkeys(CHAIN.outputs, 0.0) | {
        "time": 2.5,
        "crank_angle": PHI,
        "pawl_angle": GAMMA,
        "tooth_index": tooth,
    }
    row |= {"wheel_angle": PSI + tooth * VALUES["tooth_pitch"], "contact_force": face, "slope_force": slope}
    return pd.DataFrame([row | {"pawl_tip_deflection": -3e-9, "pawl_bending_stress": 40.0}])


def rigid_wheel():
    """The same links with the tip pinned to the wheel at the root, the crank held: a structure."""
    crank = Member("crank_beam", "crank", (0.0, 0.0), (0.11, 0.0), Section.rectangle(5e-3, 20e-3), 2.06e11, 0.0)
    pawl = Member("pawl_beam", "pawl", (0.0, 0.0), (PAWL, 0.0), Section.rectangle(6e-3, 15e-3), 2.06e11, 0.0)
    return Mechanism(
        bodies=(
            Body("crank", 1.0, 1.0, (HINGE_DISTANCE, 0.0, PHI)),
            Body("pawl", 1.0, 1.0, (*PIN, GAMMA)),
            Body("wheel", 1.0, 1.0, (0.0, 0.0, PSI)),
        ),
        joints=(
            Revolute("crank_hinge", "crank", crank.start, GROUND, (HINGE_DISTANCE, 0.0)),
            Revolute("pin", "pawl", pawl.start, "crank", crank.end),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("root", "pawl", pawl.end, "wheel", (0.1, 0.0)),
        ),
        held=("crank.angle",),
        members=(crank, pawl),
    )


@pytest.mark.parametrize("tooth", [0, 3])
def test_a_load_on_the_wheel_turns_it_back_by_what_the_structure_gives_way(tooth):
    """A torque T holds the wheel; B^T F B of the pinned structure is the oracle."""
    mechanism, torque = rigid_wheel(), -0.8
    position = np.array([[*body.start] for body in mechanism.bodies]).reshape(1, -1)
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    rest = np.zeros_like(position)
    structure = configurations(linkage(mechanism), KinematicMotion(names, np.zeros(1), position, rest, rest))
    wheel = structure.displacement("wheel")[0]
    load = torque * wheel[2]
    turned = wheel[2] @ structure.system_flexibility[0] @ load
    pin = structure.displacement("crank_beam.end")[0] @ structure.system_flexibility[0] @ load

    lever = 0.1 * (-math.sin(PSI) * math.cos(GAMMA) + math.cos(PSI) * math.sin(GAMMA))
    (found,) = compliance_of(CHAIN, VALUES, results(tooth, torque / lever), NO_IMPACTS)
    assert found.case == "contact force"
    assert found.lost_motion == pytest.approx(abs(turned), rel=1e-10)
    assert found.lost_part == pytest.approx(abs(turned) / (2 * math.pi / 10), rel=1e-10)
    assert found.resolution == pytest.approx(2 * math.pi / 10 + abs(turned), rel=1e-12)
    across = -math.sin(PHI) * pin[0] + math.cos(PHI) * pin[1]
    assert found.arm_deflection == pytest.approx(abs(across), rel=1e-10)
    # M = F_n a at the crank's hinge
    transverse = torque / lever * abs(math.sin(GAMMA - PHI))
    assert found.arm_stress == pytest.approx(abs(transverse) * 0.11 * 6 / (5e-3 * 20e-3**2), rel=1e-10)
    assert found.strut_shortening == pytest.approx(abs(torque / lever) * PAWL / (2.06e11 * 6e-3 * 15e-3), rel=1e-12)
    assert (found.time, found.strut_deflection, found.strut_stress) == (2.5, 3e-9, 40.0)


def test_a_hinged_bar_under_a_force_that_its_inertia_balances():
    """The four numbers from M = F l x (1 - x) (1 - x/2) by quadrature, and that from the bar's own inertia."""
    x, step = np.linspace(0.0, 1.0, 20001, retstep=True)
    # alpha = 3 F / m l, so that the load per length is that of 3 (1 - x): M'' = -3 (1 - x), M(0) = 0, M'(0) = 1
    moment = x - 1.5 * x**2 + 0.5 * x**3
    assert np.allclose(moment, x * (1 - x) * (1 - x / 2))
    assert moment.max() == pytest.approx(LARGEST_MOMENT, rel=1e-8)
    assert (moment**2).sum() * step == pytest.approx(ENERGY, rel=1e-7)
    assert (moment * x).sum() * step == pytest.approx(DEFLECTION, rel=1e-7)
    assert HINGE == 3 / 2 - 1  # m a of the centre is 3/2 F


def blow(speed, impulse, contact=1):
    return {"time": 2.5, "closing_speed": speed, "impulse": impulse, "tooth": 0, "contact": contact}


def test_an_impact_is_a_spring_that_takes_up_the_closing_energy():
    impacts = pd.DataFrame([blow(0.01, 1e-3), blow(0.06, 8e-3), blow(0.5, 1.0, contact=2)])
    slack = results(0, 1.0).assign(contact_force=0.0)
    (found,) = compliance_of(CHAIN, VALUES, slack, impacts)
    face = normals(0)[1]
    along = face @ [math.cos(GAMMA), math.sin(GAMMA)]
    across = face @ [-math.sin(GAMMA), math.cos(GAMMA)]
    stiffness, area = 2.06e11 * 6e-3 * 15e-3**3 / 12, 6e-3 * 15e-3
    flexibility = along**2 * PAWL / (2.06e11 * area) + across**2 * 2 / 105 * PAWL**3 / stiffness
    mass = 8e-3 / (1.2 * 0.06)
    assert found.case == "impact"
    # energy in the spring at the largest force
    assert 0.5 * flexibility * found.force**2 == pytest.approx(0.5 * mass * 0.06**2, rel=1e-12)
    assert found.strut_stress == pytest.approx(
        abs(across) * found.force * PAWL / math.sqrt(27) * 6 / (6e-3 * 15e-3**2), rel=1e-12
    )
    assert found.strut_deflection == pytest.approx(7 / 120 * abs(across) * found.force * PAWL**3 / stiffness, rel=1e-12)
    assert found.strut_shortening == pytest.approx(abs(along) * found.force * PAWL / (2.06e11 * area), rel=1e-12)


def test_an_impact_puts_no_more_energy_into_pawl_and_crank_than_it_has():
    """The crank's part, from its pin's deflection, and the pawl's under the same force are the closing energy."""
    (found,) = compliance_of(CHAIN, VALUES, results(0, 1.0).assign(contact_force=0.0), pd.DataFrame([blow(0.06, 8e-3)]))
    face = normals(0)[1]
    pawl, left = np.array([math.cos(GAMMA), math.sin(GAMMA)]), np.array([-math.sin(GAMMA), math.cos(GAMMA)])
    hinge = (face @ pawl) * pawl - 0.5 * (face @ left) * left
    across = abs(hinge @ [-math.sin(PHI), math.cos(PHI)])
    along = abs(hinge @ [math.cos(PHI), math.sin(PHI)])
    crank, area = 2.06e11 * 5e-3 * 20e-3**3 / 12, 5e-3 * 20e-3
    force = found.arm_deflection / (across * 0.11**3 / (3 * crank))
    section, bending = 6e-3 * 15e-3, 2.06e11 * 6e-3 * 15e-3**3 / 12
    energy = (face @ pawl) ** 2 * PAWL / (2.06e11 * section) + (face @ left) ** 2 * 2 / 105 * PAWL**3 / bending
    energy += across**2 * 0.11**3 / (3 * crank) + along**2 * 0.11 / (2.06e11 * area)
    assert 0.5 * energy * force**2 == pytest.approx(0.5 * 8e-3 / 1.2 * 0.06, rel=1e-12)
    assert force < found.force
    assert found.arm_stress == pytest.approx(across * force * 0.11 * 6 / (5e-3 * 20e-3**2), rel=1e-12)


def test_nothing_is_said_of_what_is_not_described_or_not_loaded():
    loaded = results(0, -1.0)
    assert compliance_of(CHAIN, VALUES, loaded.drop(columns="pawl_bending_stress"), NO_IMPACTS) == ()
    assert compliance_of(CHAIN, VALUES, loaded.assign(contact_force=0.0), NO_IMPACTS) == ()
    assert compliance_of(CHAIN, VALUES, loaded.assign(contact_force=np.nan), NO_IMPACTS) == ()
    assert compliance_section(CHAIN, ()) == ""
    assert compliance_section(None, ()) == ""
    assert set(CHAIN.variables) == set(VALUES)


def test_the_section_has_a_column_for_each_load():
    impacts = pd.DataFrame([blow(0.06, 8e-3)])
    found = compliance_of(CHAIN, VALUES, results(0, -100.0), impacts)
    text = compliance_section(CHAIN, found)
    assert "<h2>Compliance</h2>" in text
    for name in UNITS:
        assert f">{name.replace('_', ' ')}<" in text
    assert text.count("<tr>") == 1 + len(UNITS)
    assert ">contact force<" in text
    assert ">impact<" in text
    assert f">{found[0].lost_part:.4g}<" in text


def test_its_numbers_have_the_names_of_the_links():
    found = compliance_of(CHAIN, VALUES, results(0, -100.0), NO_IMPACTS)
    values = compliance_values(CHAIN, found[0])
    assert list(values)[1:] == list(UNITS)
    assert {"pawl_shortening", "crank_stress", "lost_motion"} <= set(UNITS)
    assert (values["pawl_stress"], values["crank_deflection"]) == (found[0].strut_stress, found[0].arm_deflection)
