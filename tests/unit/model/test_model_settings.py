"""Where a mechanism's settings come from: its own, else its model's parameters, else the defaults."""

from dataclasses import replace
from types import SimpleNamespace

from mechanism_fmu.model import Body, Mechanism, Model, Settings, settings_parameters

BODIES = (Body("body", 1.0, 1.0, (0.0, 0.0, 0.0)),)


def model(mechanism: Mechanism, *, with_parameters: bool = True) -> Model:
    return Model("M", "A body", settings_parameters() if with_parameters else (), lambda values: mechanism)


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
