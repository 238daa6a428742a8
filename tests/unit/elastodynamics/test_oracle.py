"""The four-bar path generator against numbers made elsewhere.

Another file of the same schema may be named by the environment variable KED_ORACLE.
"""

import json
import math
import os
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from benchmarks.path_generator import PathGenerator
from mechanism_fmu.elastodynamics import configurations, linkage, mass_matrix, quasi_static, system_forces
from mechanism_fmu.kinematics import analyse
from mechanism_fmu.model import Section

ORACLE = json.loads(
    Path(os.environ.get("KED_ORACLE", Path(__file__).parents[2] / "data" / "elastodynamics.json")).read_text()
)
WITHIN = 1e-9
#: The order of the oracle.
ELEMENTS = (
    "arm.axial",
    "arm.transverse",
    "arm.rotation",
    "crank_bar.axial",
    "crank_bar.transverse",
    "coupler_bar.rotation",
    "coupler_bar.axial",
    "follower_bar.axial",
)
DISPLACEMENTS = [f"arm.end.{c}" for c in ("x", "y", "angle")] + [f"arm.start.{c}" for c in ("x", "y", "angle")]
DISPLACEMENTS += ["coupler_bar.end.x", "coupler_bar.end.y"]


def generator(degrees):
    """The oracle's linkage, in its units, with weights as masses."""
    data = ORACLE["data"]
    gravity = 9.80665 / (0.0254 if ORACLE["units"].startswith("inch") else 1.0)

    def disk(name, radius=0.0):
        return data[f"W_{name}"] / gravity, data[f"W_{name}"] / gravity * radius**2 / 2

    return PathGenerator(
        *(data[name] for name in ("l0", "l3", "l2", "l4", "l1", "alpha")),
        Section(data["A"], data["I"], data["h"]),
        data["E"],
        data["gamma"] / gravity,
        (disk("P", data["r_P"]), disk("A", data["r_A"]), disk("B")),
        data["omega"],
        math.radians(degrees),
    )


def at(degrees):
    """The linkage in one configuration, and the oracle's orders of its coordinates."""
    mechanism = generator(degrees).mechanism()
    here = configurations(linkage(mechanism), analyse(mechanism, [0.0]))
    elements = [here.linkage.coordinates.index(name) for name in ELEMENTS]
    return here, elements, [here.coordinates.index(name) for name in DISPLACEMENTS]


def close(found, wanted):
    """Whether all numbers are within 1e-9 of the largest one of their kind (of one column, or one row)."""
    found, wanted = np.asarray(found), np.asarray(wanted)
    return bool(np.all(np.abs(found - wanted) <= WITHIN * np.abs(wanted).max()))


def along(angle):
    return math.cos(angle), math.sin(angle)


def test_flexibilities():
    here, elements, _ = at(ORACLE["case1"][0]["phi_deg"])
    assert close(here.linkage.flexibility[np.ix_(elements, elements)], ORACLE["flexibility"])


@pytest.mark.parametrize("case", ORACLE["case1"], ids=lambda case: f"{case['phi_deg']} deg")
def test_case_1(case):
    here, elements, displacements = at(case["phi_deg"])
    path = displacements[:3]
    assert close(here.pose.place("coupler", here.linkage.elements[0].member.end)[0], case["P"])
    assert here.pose.position[0, 1, 2] == pytest.approx(case["lambda"], rel=WITHIN)
    assert here.pose.position[0, 2, 2] == pytest.approx(case["psi"], rel=WITHIN)
    assert close(here.transfer[0][np.ix_(elements, path)], case["B"])
    forces = here.transfer[0][:, path] @ case["load"]
    assert close(forces[elements], case["element_forces"])
    deflection = here.system_flexibility[0][np.ix_(path, path)] @ case["load"]
    np.testing.assert_allclose(deflection, case["delta"], rtol=WITHIN)


@pytest.mark.parametrize("case", ORACLE["case2"], ids=lambda case: f"{case['phi_deg']} deg")
def test_case_2(case):
    here, elements, displacements = at(case["phi_deg"])
    angles = here.pose.position[0, :3, 2]
    directions = np.eye(8)  # of the eight system forces: along and across the crank, along coupler and follower
    directions[3:5, 3], directions[3:5, 4] = along(angles[0]), along(angles[0] + math.pi / 2)
    directions[6:8, 6], directions[6:8, 7] = along(angles[1]), along(angles[2])
    assert close(here.transfer[0][np.ix_(elements, displacements)] @ directions, case["Bprime"])

    cycle = quasi_static(here)
    assert close(system_forces(here, cycle.forces)[0][displacements], case["P_global"])
    assert close(directions @ case["P8"], case["P_global"])
    assert close(cycle.element_forces[0][elements], case["f"])
    np.testing.assert_allclose(cycle.deflection("arm.end")[0], case["delta_P"], rtol=WITHIN)
    np.testing.assert_allclose(cycle.displacement[0][displacements], case["u8"], rtol=WITHIN)
    assert cycle.reactions.of("drive")[0, 0] == pytest.approx(case["input_torque_rigid"], rel=WITHIN)


@pytest.mark.parametrize("case", ORACLE["frequencies_hz"], ids=lambda case: f"{case['phi_deg']} deg")
def test_natural_frequencies_of_case_2(case):
    here, _, _ = at(case["phi_deg"])
    squares = eigh(here.stiffness[0], mass_matrix(here)[0], eigvals_only=True)
    np.testing.assert_allclose(np.sqrt(squares[:3]) / (2 * math.pi), case["first_three"], rtol=WITHIN)
