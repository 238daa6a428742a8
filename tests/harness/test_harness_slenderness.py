"""With each stress of a design: how slender its tooth is, so that the stress can be judged."""

import math

from harness.designs.task import Quantity, When, with_slenderness
from harness.fmu.description import Description, Variable
from tests.declared import TEETH

STRESS = Quantity(When.FIRST_IMPACT, "stress_max", "Real", "Pa")
DAMAGE = Quantity(When.ALL_IMPACTS, "damage", "Real", "")
ANGLE = Quantity(When.END, "wheel_angle", "Real", "rad")
SLENDERNESS = Quantity(When.PARAMETER, "tooth_slenderness", "Real", "")


def description(*names: str) -> Description:
    variables = {name: Variable(name, k, "Real", "calculatedParameter") for k, name in enumerate(names)}
    return Description(model="Fake", identifier="Fake", guid="{}", variables=variables, analysis=TEETH)


def test_it_is_recorded_with_stresses_and_damage_once():
    known = description("tooth_length", "tooth_slenderness")
    assert with_slenderness([ANGLE, STRESS], known) == (ANGLE, STRESS, SLENDERNESS)
    assert with_slenderness([DAMAGE], known) == (DAMAGE, SLENDERNESS)
    assert with_slenderness([SLENDERNESS, STRESS], known) == (SLENDERNESS, STRESS)


def test_it_is_not_where_no_stress_is_asked_for_or_the_fmu_has_none():
    assert with_slenderness([ANGLE], description("tooth_slenderness")) == (ANGLE,)
    assert with_slenderness([STRESS], description("tooth_length")) == (STRESS,)


def test_the_ratchet_s_is_that_of_the_beam(native_ratchet_fmu):
    from harness.fmu import open_fmu
    from harness.run.experiment import Experiment, perform
    from mechanism_fmu.stress import slenderness

    with open_fmu(native_ratchet_fmu) as fmu:
        run = perform(fmu, Experiment(0.1, 0.1, {"tooth_count": 20, "tooth_slope_angle": math.radians(95)}))
    assert run.beam is not None
    assert abs(run.parameters["tooth_slenderness"] / slenderness(run.beam) - 1.0) < 1e-12
