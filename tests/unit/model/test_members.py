"""Elastic members and lumped masses: what is refused of them, and that the engine does without."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, Body, LumpedMass, Mechanism, MechanismError, Member, Revolute, Section
from mechanism_fmu.model.compile import compile_mechanism

BAR = Member("bar", "arm", (-0.5, 0.0), (0.5, 0.0), Section.rectangle(0.01, 0.02), 210e9, 7850.0)
TIP = LumpedMass("tip", "arm", (0.5, 0.0), 0.3, 1e-4)
ARM = Mechanism(
    bodies=(Body("arm", 1.0, 0.1),),
    joints=(Revolute("hinge", "arm", (-0.5, 0.0), GROUND, (-0.5, 0.0)),),
    held=("arm.angle",),
    members=(BAR,),
    lumped_masses=(TIP,),
)


def test_a_rectangle_has_the_area_and_second_moment_of_beam_theory():
    section = Section.rectangle(0.25, 0.5)
    assert (section.area, section.second_moment, section.depth) == (0.125, 0.25 * 0.5**3 / 12, 0.5)


def test_the_engine_reads_nothing_of_members():
    plain, elastic = compile_mechanism(replace(ARM, members=(), lumped_masses=())), compile_mechanism(ARM)
    assert plain.numbers == elastic.numbers
    for name in plain.columns:
        np.testing.assert_array_equal(getattr(plain, name), getattr(elastic, name))


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"members": (replace(BAR, young=0.0),)}, ["Member 'bar'", "young = 0 Pa", "positive"]),
        ({"members": (replace(BAR, young=math.inf),)}, ["young = inf Pa", "finite"]),
        ({"members": (replace(BAR, density=-1.0),)}, ["density = -1 kg/m3", "not negative"]),
        ({"members": (replace(BAR, section=Section(0.0, 1e-9, 0.01)),)}, ["area of its section = 0 m2"]),
        (
            {"members": (replace(BAR, section=Section(1e-4, math.nan, 0.01)),)},
            ["second_moment of its section = nan m4"],
        ),
        ({"members": (replace(BAR, section=Section(1e-4, 1e-9, -0.01)),)}, ["depth of its section = -0.01 m"]),
        ({"members": (replace(BAR, end=BAR.start),)}, ["(-0.5, 0)", "no length", "two different"]),
        ({"members": (replace(BAR, end=(math.inf, 0.0)),)}, ["(inf, 0)", "finite ends"]),
        ({"members": (replace(BAR, body="leg"),)}, ["Member 'bar'", "unknown body 'leg'", "arm"]),
        ({"members": (replace(BAR, body=GROUND),)}, ["'bar'", "'ground'", "part of a body"]),
        ({"members": (replace(BAR, name="arm"),)}, ["Member 'arm'", "name of its own"]),
        ({"members": (replace(BAR, name="a.b"),)}, ["'a.b'", "'.'"]),
        ({"lumped_masses": (replace(TIP, mass=-1.0),)}, ["LumpedMass 'tip'", "mass = -1 kg"]),
        ({"lumped_masses": (replace(TIP, inertia=math.nan),)}, ["inertia = nan kg.m2"]),
        ({"lumped_masses": (replace(TIP, point=(0.0, math.nan)),)}, ["(0, nan)", "not finite"]),
        ({"lumped_masses": (replace(TIP, body="leg"),)}, ["LumpedMass 'tip'", "unknown body 'leg'"]),
        ({"lumped_masses": (replace(TIP, name="bar"),)}, ["LumpedMass 'bar'", "name of another part"]),
    ],
)
def test_what_cannot_be_right_is_refused_by_name(changed, said):
    with pytest.raises(MechanismError) as error:
        compile_mechanism(replace(ARM, **changed))
    for part in said:
        assert part in str(error.value)
