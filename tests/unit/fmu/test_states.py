"""States of Model Exchange as variables: their names, and how many indicators there are."""

import pytest

import models
from mechanism_fmu.fmu.parts.states import indicator_count, state_variables, states_of
from mechanism_fmu.model import Mechanism, compile_mechanism, rigid_body
from mechanism_fmu.tables.layout import pack
from mechanism_fmu.tables.sizes import sizes_of


@pytest.mark.parametrize("name", models.available())
def test_there_are_as_many_as_the_engine_has(name):
    model = models.load(name).MODEL
    mechanism = model.build(model.values())
    sizes = sizes_of(pack(compile_mechanism(mechanism)))
    assert (len(states_of(mechanism)), indicator_count(mechanism)) == (sizes["unknowns"], sizes["indicators"])


def test_names_are_unique_and_identifiers_whatever_bodies_are_called():
    names = ("a b", "a-b", "2nd wheel", "taken")
    bodies = tuple(rigid_body(name, (0.1 * k, 0.0), mass=1.0, inertia=0.01) for k, name in enumerate(names))
    variables = state_variables(Mechanism(bodies), 7, {"taken.x"})
    found = [variable.name for variable in variables]
    assert len(set(found)) == len(found)
    assert {"a_b.x", "state.a_b.x", "_2nd_wheel.x", "state.taken.x", "taken.y"} <= set(found)
    assert [variable.value_reference for variable in variables] == list(range(7, 7 + len(variables)))
    assert [variable.derivative for variable in variables[len(found) // 2 :]] == list(range(7, 7 + len(found) // 2))
