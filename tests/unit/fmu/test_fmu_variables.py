from dataclasses import replace

from pendulum import MODEL

from mechanism_fmu.fmu.parts.variables import Variable, variables_of
from mechanism_fmu.model import Body, Mechanism, Model, Output, Parameter

BY_NAME = {v.name: v for v in variables_of(MODEL)}


def test_the_order_is_inputs_outputs_parameters_calculated_parameters() -> None:
    assert list(BY_NAME) == [
        *("bias", "torque"),
        *("angle", "wall_force", "impact_count", "impact", "impacts[1].time"),
        *("length", "mass", "teeth", "guided"),
        "inertia",
    ]


def test_value_references_count_from_1() -> None:
    assert [v.value_reference for v in variables_of(MODEL)] == list(range(1, 13))


def test_an_input_is_continuous_and_has_a_start_but_no_initial() -> None:
    assert BY_NAME["torque"] == Variable(
        name="torque",
        value_reference=2,
        type="Real",
        causality="input",
        variability="continuous",
        initial=None,
        description="Torque on the arm",
        unit="N.m",
        display_unit="mN.m",
        start=0.25,
        minimum=-1.0,
        maximum=1.0,
    )


def test_an_output_is_calculated_from_parameters_and_passes_on_its_feedthrough_inputs() -> None:
    assert BY_NAME["angle"].dependencies == ()
    assert BY_NAME["angle"].initial_dependencies == (8, 9, 10, 11)
    assert BY_NAME["wall_force"].dependencies == (1, 2)
    assert BY_NAME["wall_force"].initial_dependencies == (1, 2, 8, 9, 10, 11)
    assert (BY_NAME["angle"].initial, BY_NAME["angle"].start) == ("calculated", None)


def test_outputs_that_change_at_impacts_only_are_discrete_and_depend_on_nothing_at_first() -> None:
    discrete = {v.name for v in BY_NAME.values() if v.variability == "discrete"}
    assert discrete == {"impact_count", "impact", "impacts[1].time"}
    assert all(BY_NAME[name].initial_dependencies == () for name in discrete)


def test_a_body_whose_name_begins_like_an_impact_is_continuous() -> None:
    mechanism = Mechanism((Body("impactor", 1.0, 1.0),), outputs=(Output("x", "impactor.x", "", "m"),))
    (variable,) = variables_of(Model("M", "", (), lambda _: mechanism, drawing=()))
    assert variable.variability == "continuous"


def test_parameters_are_fixed_and_have_starts_of_their_type() -> None:
    assert [BY_NAME[name].start for name in ("length", "teeth", "guided")] == [1.5, 3, True]
    assert [type(BY_NAME[name].start) for name in ("length", "teeth", "guided")] == [float, int, bool]
    assert {(v.variability, v.initial) for v in BY_NAME.values() if v.causality == "parameter"} == {("fixed", "exact")}


def test_only_reals_have_units() -> None:
    assert {v.name for v in BY_NAME.values() if v.unit is None} == {"impact_count", "impact", "teeth", "guided"}


def test_a_calculated_parameter_depends_on_the_parameters() -> None:
    inertia = BY_NAME["inertia"]
    assert (inertia.causality, inertia.variability, inertia.initial) == ("calculatedParameter", "fixed", "calculated")
    assert inertia.initial_dependencies == (8, 9, 10, 11)


def test_a_whole_number_as_start_of_a_real_becomes_a_float() -> None:
    model = replace(MODEL, parameters=(*MODEL.parameters[:3], Parameter("guided", 1, "A number", "1")))
    assert repr(variables_of(model)[10].start) == "1.0"
