"""Cases of models: signals over time by hand, what is refused, and the cases of the ready models."""

import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

import models
from harness.papers.study import indexing
from mechanism_fmu.fmu.own.examine import examine
from mechanism_fmu.fmu.own.find import write_new
from mechanism_fmu.fmu.own.prepare import load
from mechanism_fmu.model import Case, MechanismError, SineSignal, TableSignal, port_builders
from mechanism_fmu.model.case_values import case_values

MODEL = models.load("ratchet").MODEL


def test_signals_over_time() -> None:
    sine = SineSignal(2.0, 0.5, 4.0, math.pi / 2)
    assert [sine.at(t) for t in (0.0, 1.0, 2.0)] == pytest.approx([2.5, 2.0, 1.5])
    assert sine.span == (1.5, 2.5)
    table = TableSignal((1.0, 2.0, 4.0), (0.0, 1.0, -1.0))
    assert [table.at(t) for t in (0.0, 1.0, 1.25, 2.0, 3.0, 4.0, 9.0)] == [0.0, 0.0, 0.25, 1.0, 0.0, -1.0, -1.0]
    assert table.span == (-1.0, 1.0)


@pytest.mark.parametrize("name", models.available())
def test_cases_of_the_ready_models_are_right(name: str) -> None:
    model = models.load(name).MODEL
    for case in model.cases:
        values = case_values(model, case)
        assert set(values) == set(case.values)


def test_indexing_is_the_cycle_of_the_study() -> None:
    (case,) = (one for one in MODEL.cases if one.name == "indexing")
    assert case_values(MODEL, case) == indexing.VALUES
    assert case.stop_time == indexing.STOP_TIME
    for time in (0.0, 1.3, 5.0):
        turn = 2 * math.pi * time / indexing.PERIOD
        angle, speed = (case.signals[name].at(time) for name in ("drive_angle", "drive_speed"))
        assert angle == pytest.approx(indexing.MEAN - indexing.AMPLITUDE * math.cos(turn), abs=1e-15)
        assert speed == pytest.approx(indexing.AMPLITUDE * 2 * math.pi / indexing.PERIOD * math.sin(turn), abs=1e-15)


def test_values_may_be_texts() -> None:
    assert case_values(MODEL, Case("wide", "", {"crank_length": "120 mm"})) == {"crank_length": 0.12}


@pytest.mark.parametrize(
    ("case", "message"),
    [
        (Case("A case", ""), "Ratchet: case 'A case': its name must be of small letters"),
        (Case("start", ""), "Ratchet: case 'start': that is what the start values of the model are called"),
        (Case("guided", ""), "Ratchet: case 'guided' is there twice"),
        (Case("a", "", {"crank": 1.0}), "Ratchet: case 'a': there is no 'crank'; there are: baumgarte_alpha, "),
        (
            Case("a", "", signals={"crank_length": SineSignal(0.1, 0.0, 1.0)}),
            "there is no 'crank_length'; there are: dri",
        ),
        (Case("a", "", {"crank_length": -1.0}), "case 'a': crank_length = -1, but it must be from 1e-09 to 1000"),
        (Case("a", "", signals={"load_torque": TableSignal((0.0,), (2e6,))}), "load_torque = 2e+06, but it must be"),
        (Case("a", "", {"tooth_count": 10.5}), "tooth_count = 10.5 is not a whole number"),
        (Case("a", "", {"crank_length": "1 s"}), "crank_length wants m, got '1 s'"),
        (Case("a", "", stop_time=0.0), "case 'a': stop_time = 0 s, but it must be positive and finite"),
    ],
)
def test_what_is_no_case_is_refused(case: Case, message: str) -> None:
    model = replace(MODEL, cases=(*MODEL.cases, case))
    with pytest.raises(MechanismError, match=re.escape(message)):
        case_values(model, case)


@pytest.mark.parametrize(
    "made",
    [
        lambda: SineSignal(0.0, 1.0, 0.0),
        lambda: SineSignal(math.nan, 1.0, 1.0),
        lambda: TableSignal((0.0, 1.0), (1.0,)),
        lambda: TableSignal((), ()),
        lambda: TableSignal((1.0, 0.0), (1.0, 2.0)),
        lambda: TableSignal((0.0,), (math.inf,)),
    ],
)
def test_what_is_no_signal_is_refused(made: object) -> None:
    with pytest.raises(MechanismError, match="Signal"):
        made()  # type: ignore[operator]


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: SineSignal("1 N.m", 1.0, 1.0), "'1 N.m' is no plain number"),  # type: ignore[arg-type]
        (lambda: TableSignal(0.0, (1.0, 2.0)), "two tuples of numbers"),  # type: ignore[arg-type]
        (lambda: TableSignal((0.0, "1 s"), (1.0, 2.0)), "'1 s' is no plain number"),  # type: ignore[arg-type]
    ],
)
def test_what_is_no_signal_is_refused_in_words(make, words) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(MechanismError, match=re.escape(words)):
        make()


def test_a_number_in_the_place_of_a_signal_is_refused_in_words() -> None:
    case = Case("own", "", signals={"load_torque": 3.0})  # type: ignore[dict-item]
    with pytest.raises(MechanismError, match="give a SineSignal or a TableSignal"):
        case_values(MODEL, case)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ('Case("own", "", {"nosuch": 1.0})', "there is no 'nosuch'"),
        ('Case("own", "", {}, stop_time="16 s")', "stop_time"),
        ('Case("own", "", signals={"motor_torque": 3.0})', "SineSignal"),
        ('Case(1, "")', "name"),
    ],
)
def test_check_names_the_mistake_in_a_case(given: str, words: str, tmp_path: Path) -> None:
    path = write_new("lever", tmp_path)
    text = path.read_text().replace("from mechanism_fmu.model import", "from mechanism_fmu.model import Case,", 1)
    text += f"\nfrom dataclasses import replace\n\nMODEL = replace(MODEL, cases=({given},))\n"
    path.write_text(text)
    with pytest.raises(MechanismError, match=re.escape(words)):
        examine(load(path), path, native=False)


def test_lengths_of_links_are_texts_too() -> None:
    length, *_, centre = port_builders.link_parameters("crank", "50 mm", 0.1, 1e-4, "20 mm", "its hinge")  # type: ignore[arg-type]
    assert (length.start, centre.start, centre.usual) == (0.05, 0.02, (-0.025, 0.05))
    assert port_builders.shaft_parameters("0.1 N.m.s/rad")[1].usual == (0.0, 0.2)  # type: ignore[arg-type]
    assert port_builders.shaft_parameters(0.0, 0.0)[1].usual is None
