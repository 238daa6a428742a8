"""What a mechanism leaves open, and its model says: settings (among the parameters), inputs, outputs, calculated."""

from dataclasses import replace
from types import SimpleNamespace

from mechanism_fmu.model import Body, Calculated, Input, Mechanism, Model, Output, Settings, Torque, settings_parameters

BODIES = (Body("body", 1.0, 1.0, (0.0, 0.0, 0.0)),)


def model(mechanism: Mechanism, *, with_parameters: bool = True) -> Model:
    return Model("M", "A body", settings_parameters() if with_parameters else (), lambda values: mechanism, drawing=())


def test_settings_among_the_parameters_are_those_of_a_mechanism_that_gives_none() -> None:
    free = model(Mechanism(BODIES))
    values = free.values(relative_tolerance=1e-6, max_internal_steps=123)
    assert free.mechanism(values).settings == Settings(1e-6, max_internal_steps=123)
    assert free.build(values).settings == Settings(1e-6, max_internal_steps=123)


def test_settings_of_its_own_stay() -> None:
    own = model(Mechanism(BODIES, settings=Settings(1e-5)))
    assert own.build(own.values(relative_tolerance=1e-6)).settings == Settings(1e-5)


def test_without_such_parameters_the_defaults_stand() -> None:
    plain = model(Mechanism(BODIES), with_parameters=False)
    assert plain.build(SimpleNamespace()).settings == Settings()


def test_a_copy_of_a_model_is_equal_to_it() -> None:
    free = model(Mechanism(BODIES))
    assert replace(free) == free


def test_ports_of_the_model_are_those_of_a_mechanism_that_gives_none() -> None:
    inputs, outputs = (Input("torque", "load.torque", 0.0, "T", "N.m"),), (Output("angle", "body.angle", "A", "rad"),)
    given = Mechanism(BODIES, forces=(Torque("load", "body"),))
    whole = replace(
        model(given),
        inputs=inputs,
        outputs=outputs,
        calculated=lambda values: (Calculated("tenth", values.relative_tolerance / 10, "T", "1"),),
    )
    made = whole.build(whole.values(relative_tolerance=1e-6))
    assert (made.inputs, made.outputs) == (inputs, outputs)
    assert [(c.name, c.value) for c in made.calculated] == [("tenth", 1e-6 / 10)]
    other = (Output("speed", "body.speed", "S", "rad/s"),)
    own = replace(whole, mechanism=lambda values: replace(given, outputs=other))
    assert own.build(own.values()).outputs == other
    assert own.build(own.values()).inputs == inputs
