"""docs/explanation/escapements.md: a short form of its numbers, its message is the model's, its links hold."""

import re

import pytest
from pages import JOINTS

import models
from benchmarks.escapements import ESCAPEMENTS, FACTORS, rate_of_reference, steady
from docs.drawings.escapements_drawing import FIGURE, NAMED, with_numbers
from docs.drawings.gallery_drawing import picture

PAGE = JOINTS.parent / "explanation" / "escapements.md"
TEXT = PAGE.read_text(encoding="utf-8")
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")


def row(start: str) -> list[str]:
    """The cells of a row behind its first."""
    (found,) = re.findall(rf"^\| {re.escape(start)} \| (.*) \|$", TEXT, re.MULTILINE)
    return [cell.strip() for cell in found.split("|")]


def test_periods_of_the_quick_ones_are_those_of_the_page() -> None:
    for one in ESCAPEMENTS:
        if one.body == "pendulum":
            continue
        column = list(NAMED).index(one.model)
        for factor in (FACTORS[0], FACTORS[-1]) if one.settles < 30.0 else (1.0,):
            assert steady(one, factor).period == pytest.approx(float(row(f"{factor:g}")[column]), abs=2e-6)


def test_rates_of_the_reference_runs_are_those_of_the_page() -> None:
    for one in ESCAPEMENTS:
        told = float(row(f"[{NAMED[one.model][0]}](../../models/{one.model})")[-1])
        assert rate_of_reference(one) == pytest.approx(told, abs=2e-3)


def test_exponents_are_those_of_theory() -> None:
    told = {name: float(row(f"[{called}](../../models/{name})")[3]) for name, (called, _) in NAMED.items()}
    assert told["verge"] == pytest.approx(-0.5, abs=1e-6)
    assert abs(told["graham"]) < 1e-3
    assert told["recoil_anchor"] < -3e-3
    assert -1e-2 < told["pin_pallet"] < 0.0
    assert abs(told["lever_escapement"]) < 3e-4


def test_the_message_is_that_of_the_model() -> None:
    model = models.load("graham").MODEL
    (said,) = model.refused(model.values(tip_radius=3e-4))
    (told,) = re.findall(r"```text\n(The anchor.*?)```", TEXT, re.DOTALL)
    assert told.split() == said.split()


def test_tables_are_written_in_their_places() -> None:
    page = with_numbers("a\n<!-- each -->\nold\n<!-- end -->\nb\n", {"each": "new"})
    assert page == "a\n<!-- each -->\nnew\n<!-- end -->\nb\n"


@pytest.mark.parametrize("one", ESCAPEMENTS, ids=lambda one: one.model)
def test_the_drawing_of_a_model_is_the_one_that_is_drawn(one) -> None:
    """Places may differ by rounding, which is another on another processor."""
    kept = (models.available()[one.model] / "drawing.svg").read_text(encoding="utf-8")
    drawn = picture(one.described)
    assert _NUMBER.sub("#", kept) == _NUMBER.sub("#", drawn), "python -m docs.drawings.escapements_drawing"
    places = [[float(number) for number in _NUMBER.findall(text)] for text in (kept, drawn)]
    assert places[0] == pytest.approx(places[1], abs=0.02)


def test_what_it_links_to_is_there() -> None:
    targets = re.findall(r"\]\(([^)#]+)", TEXT)
    assert f"({FIGURE.name})" in TEXT
    assert not [target for target in targets if not (PAGE.parent / target).exists()]
