"""What a first user types: a model instead of its mechanism, and texts with units."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from mechanism_fmu.fmu.own.examine import _check_variables
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    MechanismError,
    Model,
    Output,
    Revolute,
    Section,
    bar,
    length_parameter,
)
from mechanism_fmu.simulation import simulate


def pendulum(values: SimpleNamespace) -> Mechanism:
    rod = bar("rod", (0, 0), length=values.length, angle=0.0, mass="1 kg")
    return Mechanism((rod,), (Revolute("pin", rod.a, GROUND.at(0, 0)),), gravity=(0.0, -9.81), held=(rod.angle,))


MODEL = Model("Pendulum", "", (length_parameter("length", 0.4, "Length"),), pendulum)


def test_a_model_is_run_with_its_default_values_and_times_have_units() -> None:
    short = simulate(MODEL, until="500 ms", step="50ms")
    plain = simulate(MODEL.build(MODEL.values()), until=0.5, step=0.05)
    assert short.table.equals(plain.table)


def test_values_and_sections_take_texts_with_units() -> None:
    assert MODEL.values(length="45 mm").length == pytest.approx(0.045, rel=1e-15)
    assert Section.rectangle("5 mm", "2 cm") == Section.rectangle(0.005, 0.02)
    with pytest.raises(MechanismError, match="length wants m, got '45 kg'"):
        MODEL.values(length="45 kg")
    with pytest.raises(MechanismError, match="until wants s, got '2 m'"):
        simulate(MODEL, until="2 m")
    with pytest.raises(MechanismError, match="Pendulum has no parameter 'Q'; it has: length"):
        MODEL.values(Q="45 mm")


def test_a_parameter_may_have_the_name_of_what_the_drawing_reads() -> None:
    model = replace(MODEL, parameters=(*MODEL.parameters, length_parameter("rod_x", 0.4, "Of nothing")))
    named = replace(model, outputs=(Output("angle", "rod.angle", "", "rad"),))
    for one in (model, named):
        names = [variable.name for variable in variables_of(one)]
        assert len(names) == len(set(names))
    assert named.shapes[0].at == ("rod_x_2", "rod_y")


def test_no_parameter_is_called_time() -> None:
    model = replace(MODEL, parameters=(*MODEL.parameters, length_parameter("time", 0.4, "Of nothing")))
    with pytest.raises(MechanismError, match="Parameter 'time': tables and FMUs have a column of time by that name"):
        _check_variables(model)
