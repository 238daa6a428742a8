"""docs/explanation/friction.md: its example prints what it says, its pictures are the script's, its table holds."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from pages import JOINTS, examples, what_prints

from docs.drawings.friction_drawing import DRAWINGS, PICTURES
from mechanism_fmu.model import CamFlatFollower, CamFollower, Mechanism, PointFollower, PointLineContact, Revolute

PAGE = JOINTS.parent / "explanation" / "friction.md"
TEXT = PAGE.read_text(encoding="utf-8")
ANALYTIC = Path(__file__).parents[1] / "analytic"
_NUMBER = re.compile(r"\d\.\de-\d\d")


def test_examples_print_what_the_page_says():
    found = examples_with_output()
    assert found
    for program, expected in found:
        assert what_prints(program, PAGE) == expected


def examples_with_output():
    return examples(PAGE)


def test_its_table_holds(monkeypatch):
    """But for rounding, which is another on another processor. In this process, whose engine is compiled already."""
    monkeypatch.syspath_prepend(ANALYTIC)
    printed = importlib.import_module("friction_table").table()
    (kept,) = re.findall(r"<!-- table -->\n(.*?)<!-- end -->", TEXT, re.DOTALL)
    assert _NUMBER.sub("#", kept) == _NUMBER.sub("#", printed), "python tests/analytic/friction_table.py"
    stated, found = ([float(number) for number in _NUMBER.findall(text)] for text in (kept, printed))
    assert len(stated) > 15
    assert all(now <= 5.0 * said + 1e-13 for now, said in zip(found, stated, strict=True))


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_picture_is_that_of_its_script(name):
    """But for the last digits of its places [px], which another processor may round otherwise."""
    number = re.compile(r"-?\d+\.\d+")
    kept, drawn = (PICTURES / f"{name}.svg").read_text(encoding="utf-8"), DRAWINGS[name]()
    assert f"({name}.svg)" in TEXT
    assert number.sub("#", kept) == number.sub("#", drawn), "python -m docs.drawings.friction_drawing"
    places = ([float(x) for x in number.findall(text)] for text in (kept, drawn))
    np.testing.assert_allclose(*places, rtol=0, atol=0.021)


@pytest.mark.parametrize("part", [CamFlatFollower, CamFollower, PointFollower, PointLineContact, Revolute, Mechanism])
def test_arguments_that_it_names_are_there(part):
    names = {"impact_law", "energy_guard", "tangential_shock"} if part is Mechanism else set()
    names = names or {"friction_static", "friction_radius" if part is Revolute else "friction"}
    assert all(f"`{name}`" in TEXT or f"{name}=" in TEXT for name in names)
    assert names <= set(part.__dataclass_fields__)


def test_what_it_links_to_is_there():
    targets = re.findall(r"\]\(([^)#]+)", TEXT)
    assert targets
    assert not [target for target in targets if not (PAGE.parent / target).exists()]
