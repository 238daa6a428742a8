"""The analyses that a model declares, as they travel in its FMU, and what is refused at the build."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest

import models
from mechanism_fmu.fmu.parts.resources import ANALYSIS, analysis
from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    ImpactStress,
    Mechanism,
    MechanismError,
    Model,
    Output,
    RectangularTooth,
    Revolute,
    TableBeam,
    TrapezoidTooth,
    impact_outputs,
    length_parameter,
)

BEAM = RectangularTooth("length", 0.01)


def mechanism(values: SimpleNamespace) -> Mechanism:
    """An arm between two stops of which the upper one is a second body's."""
    return Mechanism(
        bodies=(Body("arm", 1.0, 1.0, tooth_length=values.length), Body("gate", 1.0, 1.0)),
        joints=(Revolute("hinge", "arm", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        contacts=(AngleStop("gate_stop", "gate", GROUND, -1.0), AngleStop("stop", "arm", GROUND, -1.0)),
        outputs=(*impact_outputs("Impacts", [Output("velocity", "velocity", "v_I of {impact}", "m/s")]),),
    )


MODEL = Model("Arm", "An arm", (length_parameter("length", 0.2, "Length"),), mechanism)


def declared(*analyses: object) -> dict[str, bytes]:
    return analysis(replace(MODEL, analysis=analyses))  # type: ignore[arg-type]


def test_a_model_without_analyses_has_no_file() -> None:
    assert analysis(MODEL) == {}


def test_the_file_has_the_declaration_with_what_the_mechanism_says_of_it() -> None:
    assert ANALYSIS == "resources/analysis.json"
    assert json.loads(declared(ImpactStress("stop", BEAM, "arm", "arms"))[ANALYSIS]) == {
        "format": 1,
        "analyses": [
            {
                "kind": "ImpactStress",
                "contact": 1,
                "beam": {"kind": "RectangularTooth", "length": "length", "height": 0.01},
                "name": "arm",
                "plural": "arms",
                "jump": "velocity",
                "body": "arm",
                "striker": "ground",
            }
        ],
    }


def test_the_same_declaration_gives_the_same_bytes() -> None:
    model = models.load("ratchet").MODEL
    assert analysis(model) == analysis(replace(model))
    assert analysis(model)[ANALYSIS].decode("ascii").endswith("}\n")


REFUSED = {
    "no such contact": (ImpactStress("face", BEAM), "there is no contact 'face'; contacts: gate_stop, stop"),
    "a contact of another body": (ImpactStress("gate_stop", BEAM), "is between gate and ground, and one of them must"),
    "no such variable": (ImpactStress("stop", RectangularTooth("width", 0.01)), "no parameter or calculated parameter"),
    "no such field": (ImpactStress("stop", BEAM, jump="speed"), r"records of impacts 'speed'; name one .*velocity"),
    "no such slenderness": (ImpactStress("stop", BEAM, slenderness="slim"), "calculated parameter 'slim'"),
    "no number": (ImpactStress("stop", RectangularTooth("length", float("nan"))), "height = nan is not a finite"),
    "no such variable in a table": (
        ImpactStress("stop", TableBeam((0.0, "length"), (1e-4, "a"), (1e-9, 1e-9), (5e-3, 5e-3))),
        r"TableBeam, areas\[1\]: the model has no parameter or calculated parameter 'a'",
    ),
    "no number in a table": (
        ImpactStress("stop", TableBeam((0.0, "length"), (1e-4, float("inf")), (1e-9, 1e-9), (5e-3, 5e-3))),
        r"areas\[1\] = inf is not a finite number",
    ),
    "a table of another length": (ImpactStress("stop", TableBeam((0.0, 0.3), *3 * [(1e-4, 1e-4)])), "0.3 m long, but"),
    "another length": (ImpactStress("stop", TrapezoidTooth(0.3, 0.1, 0.0)), "0.3 m long, but 'arm' has tooth_length"),
}  # fmt: skip


def test_a_table_is_as_it_is_declared_and_the_length_its_last_place() -> None:
    table = TableBeam((0.0, 0.1, "length"), (2e-4, 1e-4, 1e-4), (2e-9, 1e-9, 1e-9), (5e-3, 4e-3, 4e-3))
    (entry,) = json.loads(declared(ImpactStress("stop", table))[ANALYSIS])["analyses"]
    assert entry["beam"] == {
        "kind": "TableBeam",
        "places": [0.0, 0.1, "length"],
        "areas": [2e-4, 1e-4, 1e-4],
        "second_moments": [2e-9, 1e-9, 1e-9],
        "outer_fibres": [5e-3, 4e-3, 4e-3],
    }


@pytest.mark.parametrize("columns", [((0.0, 0.2), (1.0, 1.0), (1.0,), (1.0, 1.0)), ((), (), (), ()), ((0.2,),) * 4])
def test_columns_that_are_no_table_are_refused(columns: tuple[tuple[float, ...], ...]) -> None:
    with pytest.raises(MechanismError, match="give as many of each, at root and tip at least"):
        TableBeam(*columns)


@pytest.mark.parametrize("case", REFUSED)
def test_what_does_not_fit_the_mechanism_is_refused(case: str) -> None:
    wrong, said = REFUSED[case]
    with pytest.raises(MechanismError, match=said):
        declared(wrong)


def test_a_kind_of_analysis_is_there_once() -> None:
    with pytest.raises(MechanismError, match="ImpactStress is asked for 2 times"):
        declared(ImpactStress("stop", BEAM), ImpactStress("stop", BEAM))
