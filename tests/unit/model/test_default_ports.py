"""Outputs of a mechanism that declares none."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

import models
from mechanism_fmu.fmu.parts.fmi_units import parse_unit
from mechanism_fmu.fmu.parts.model_description import model_description
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    AngleStop,
    Body,
    Brake,
    Input,
    Mechanism,
    MechanismError,
    Model,
    Parameter,
    Revolute,
    SpringDamper,
    Torque,
    Translational,
    compile_mechanism,
    default_outputs,
    impact_outputs,
    polynomial_motion,
    torque_input,
)
from mechanism_fmu.moving import MovingMechanism
from mechanism_fmu.tables.layout import field_of, pack

ZERO = (0.0, 0.0)


def arm(**parts):
    """A bar on a hinge, with a motor."""
    return Mechanism(
        bodies=(Body("arm", 1.0, 1.0, start=(0.5, 0.0, 0.0)),),
        joints=(Revolute("pin", "arm", (-0.5, 0.0), GROUND, ZERO),),
        inputs=(torque_input("motor", "arm"),),
        **{"forces": (Torque("motor", "arm"),), **parts},
    )


def test_all_parts_are_there_with_units_and_feedthrough():
    spring = SpringDamper(
        name="spring", body="arm", point=ZERO, reaction=GROUND, reaction_point=(0.0, 2.0), stiffness=1.0
    )
    mechanism = arm(forces=(Torque("motor", "arm"), spring), contacts=(AngleStop("stop", "arm", GROUND, -1.0),))
    preload = Input("pull", "spring.preload", 0.0, "", "N")
    found = {o.name: o for o in default_outputs(replace(mechanism, inputs=(*mechanism.inputs, preload)))}
    units = {name: output.unit for name, output in found.items() if "[" not in name}
    assert (
        units.items()
        >= {
            "arm_x": "m",
            "arm_y": "m",
            "arm_angle": "rad",
            "arm_speed": "rad/s",
            "spring_length": "m",
            "spring_force": "N",
            "spring_power": "W",
            "pin_force_x": "N",
            "pin_force_y": "N",
            "stop_force": "N.m",
            "stop_gap": "rad",
            "stop_active": "1",
            "kinetic_energy": "J",
            "energy_lost": "J",
            "event_count": "1",
            "impact_count": "1",
            "impact_closing_speed": "rad/s",
            "impact_impulse": "N.m.s",
            "impacts_in_step": "1",
        }.items()
    )
    assert (found["arm_angle"].display_unit, found["arm_speed"].display_unit) == ("deg", "rpm")
    assert found["spring_force"].feedthrough == ("pull",)
    assert found["spring_length"].feedthrough == ()
    assert found["pin_force_x"].feedthrough == ("motor_torque", "pull")
    assert {"impacts[8].closing_speed", "events[16].guard"} <= found.keys()
    assert all(output.description and parse_unit(output.unit).factor == 1.0 for output in found.values())


def test_without_contacts_there_are_no_impacts():
    assert not [o.name for o in default_outputs(arm()) if "impact" in o.name or "event" in o.name]


def test_what_may_rub_has_slip_friction_and_whether_it_sticks():
    """A slider and a brake, with units of their own; events, for it sticks and slips; nothing of a pin without."""
    slider = Translational("guide", GROUND, ZERO, (1.0, 0.0), "arm", ZERO, (1.0, 0.0), friction=0.1)
    mechanism = replace(arm(), joints=(slider,), forces=(Torque("motor", "arm"), Brake("brake", "arm", limit=1.0)))
    found = {output.name: output for output in default_outputs(mechanism)}
    of = {name: (found[f"{name}_slip_speed"].unit, found[f"{name}_friction_force"].unit) for name in ("guide", "brake")}
    assert of == {"guide": ("m/s", "N"), "brake": ("rad/s", "N.m")}
    assert found["guide_friction_force"].feedthrough == ("motor_torque",)
    assert found["brake_sticks"].type == "Boolean"
    assert {"event_count", "events[1].guard"} <= found.keys()
    assert "impact_count" not in found
    assert not [output.name for output in default_outputs(arm()) if "slip" in output.name or "sticks" in output.name]


def test_friction_that_a_parameter_may_bring_is_seen():
    def mechanism(values):
        pin = Revolute("pin", "arm", (-0.5, 0.0), GROUND, ZERO, values.rubbing)
        return replace(arm(), joints=(pin,))

    model = Model("Arm", "", (Parameter("rubbing", 0.0, "", "m"),), mechanism)
    for rubbing in (0.0, 0.1):
        assert "pin_sticks" in [output.name for output in model.build(model.values(rubbing=rubbing)).outputs]
    assert "pin_sticks" in {one.get("name") for one in model_description(model, "").iter("ScalarVariable")}


def test_a_name_that_is_taken_is_not_taken_twice():
    driver = AngleDriver("motor", "arm", polynomial_motion(0.0, 1.0))
    mechanism = replace(arm(), joints=(*arm().joints, driver), inputs=(torque_input("motor", "arm"),))
    assert "motor_torque_out" in {output.name for output in default_outputs(mechanism)}
    assert "arm_x_out" in {output.name for output in default_outputs(arm(), taken=("arm_x",))}


@pytest.mark.parametrize("name", models.available())
def test_the_outputs_of_every_model_could_be_the_default_ones(name):
    """They can be read, and are finite at the start."""
    model = models.load(name).MODEL
    mechanism = model.build(model.values())
    default = replace(mechanism, outputs=default_outputs(mechanism))
    compile_mechanism(default)
    values = MovingMechanism(default).read()
    assert len(values) == len(default.outputs) + len(default.calculated)
    assert len({output.name for output in default.outputs}) == len(default.outputs)


def test_a_model_without_outputs_has_them_and_one_with_has_its_own():
    model = Model("Arm", "", (Parameter("arm_x", 0.0, ""),), lambda values: arm())
    names = [output.name for output in model.build(model.values()).outputs]
    assert {"arm_x_out", "arm_angle"} <= set(names)
    variables = model_description(model, "").iter("ScalarVariable")
    assert {"arm_angle", "arm_x"} <= {variable.get("name") for variable in variables}
    one = default_outputs(arm())[2]
    own = Model("Arm", "", (), lambda values: arm(), outputs=(one,), drawing=())
    assert own.build(own.values()).outputs == (one,)
    assert (model.declares_outputs, own.declares_outputs) == (False, True)


def test_a_mistake_in_the_parts_is_left_to_those_who_object():
    wrong = Model("Arm", "", (), lambda values: Mechanism(bodies=Body("arm", 1.0, 1.0)))
    assert wrong.mechanism(SimpleNamespace()).outputs == ()


# --- how many impacts are kept ---------------------------------------------------------------------------------------


def stopped(**outputs):
    """An arm that a torque presses against an elastic stop: it bounces for ever."""
    return replace(arm(contacts=(AngleStop("stop", "arm", GROUND, 0.0, restitution=1.0),)), **outputs)


@pytest.mark.parametrize("kept", [8, 9, 40])
def test_a_model_chooses_how_many_impacts_are_kept(kept):
    mechanism = stopped(outputs=impact_outputs("Impacts", [], kept))
    assert len(field_of(pack(compile_mechanism(mechanism)), "impacts")) == kept
    mechanism = replace(
        mechanism, bodies=(Body("arm", 1.0, 1.0, (0.5, 0.0, 0.0), (0.0, 0.0, 1.0)),), held=("arm.angle",)
    )
    simulation = MovingMechanism(mechanism, inputs=[-10.0])
    simulation.advance(12.0)
    values = simulation.read()
    assert values["impact_count"] > 40
    assert len(simulation.impacts_in_step()) == values["impacts_in_step"] == kept
    assert values["impacts_lost"] == values["impact_count"] - kept
    assert values[f"impacts[{kept}].time"] == values["impact_time"]


def test_without_outputs_of_impacts_eight_are_kept():
    assert len(field_of(pack(compile_mechanism(stopped())), "impacts")) == 8


@pytest.mark.parametrize("kept", [7, 1001])
def test_other_numbers_are_refused(kept):
    with pytest.raises(MechanismError, match=rf"kept = {kept}: of a step 8 to 1000 can be kept"):
        impact_outputs("Impacts", [], kept)
