"""The pages of the joint library say what is true."""

import inspect
import re
from typing import get_args

import numpy as np
import pytest
from pages import JOINTS, PAGES, examples, what_prints

from docs.joints.drawings import DRAWINGS
from mechanism_fmu.model import joints
from mechanism_fmu.model.joints import Joint
from tests.public import listed_by

EXAMPLES = [
    pytest.param(page, program, printed, id=f"{page.stem}-{number}")
    for page in PAGES
    for number, (program, printed) in enumerate(examples(page), start=1)
]
CLASSES = [name for name in listed_by(joints) or () if isinstance(getattr(joints, name), type)]
OVERVIEW = JOINTS / "README.md"
#: Drivers whose arguments are those of `XDriver`.
LIKE_ANOTHER = ("YDriver", "DistanceDriver")
#: Each page of joints states them in this order.
STEPS = ["**Allows**", "**Φ**", "**Φ_q**", "**ν**", "**γ**"]


@pytest.mark.parametrize(("page", "program", "printed"), EXAMPLES)
def test_an_example_prints_what_its_page_says(page, program, printed):
    assert what_prints(program, page) == printed


def pages_of(name):
    return [page for page in PAGES if page != OVERVIEW and re.search(rf"`{name}\b", page.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("name", CLASSES)
def test_every_joint_has_a_page_with_an_example_of_it(name):
    shown = [
        page for page in pages_of(name) if any(re.search(rf"\b{name}\(", program) for program, _ in examples(page))
    ]
    assert shown, f"{name} is in no page of docs/joints that shows it at work"
    assert any(f"({page.name})" in OVERVIEW.read_text(encoding="utf-8") for page in shown)


@pytest.mark.parametrize("name", CLASSES)
def test_a_page_names_the_arguments_of_its_joint(name):
    """All of them in their order, and which may be left out."""
    arguments = inspect.signature(getattr(joints, name)).parameters.values()
    expected = [(argument.name, argument.default is not argument.empty) for argument in arguments]
    shown = [text for page in pages_of(name) for text in re.findall(rf"`{name}\(([^`]*)\)`", page.read_text("utf-8"))]
    for text in shown:
        parts = [part.partition("=") for part in re.split(r",\s(?=[a-z])", text)]
        assert [(argument, bool(default)) for argument, _, default in parts] == expected
    assert shown or name in LIKE_ANOTHER


@pytest.mark.parametrize("name", CLASSES)
def test_a_joint_says_its_five_steps_itself(name):
    steps = re.findall(r"^    (\d\. \w+)", getattr(joints, name).__doc__, re.MULTILINE)
    assert steps == ["1. Allows", "2. Phi", "3. Phi_q", "4. nu", "5. gamma"]


@pytest.mark.parametrize("joint", get_args(Joint))
def test_a_page_names_the_forces_that_can_be_asked_for(joint):
    name = joint.__name__
    for quantity in joint.efforts:
        assert any(re.search(rf"`(<name>\.)?{quantity}`", page.read_text("utf-8")) for page in pages_of(name))


@pytest.mark.parametrize(
    "page", [page for page in PAGES if page.stem not in ("README", "profiles")], ids=lambda p: p.stem
)
def test_a_page_has_the_five_steps_traps_and_a_drawing(page):
    text = page.read_text(encoding="utf-8")
    items = re.findall(r"^\d\. (\*\*\S+\*\*)", text, re.MULTILINE)
    assert items == STEPS
    assert "## Traps" in text
    assert f"({page.stem}.svg)" in text


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.stem)
def test_what_a_page_points_to_is_there(page):
    targets = re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8"))
    targets += re.findall(r'src="([^"]+)"', page.read_text(encoding="utf-8"))
    missing = [target for target in targets if not (page.parent / target).exists()]
    assert not missing


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_drawing_is_that_of_its_script(name):
    """But for the last digit of its numbers [px], which another processor may round otherwise."""
    number = re.compile(r"-?\d+\.\d+")
    kept, drawn = (JOINTS / f"{name}.svg").read_text(encoding="utf-8"), DRAWINGS[name]()
    assert number.sub("#", kept) == number.sub("#", drawn), "python -m docs.joints.drawings"
    np.testing.assert_allclose(
        [float(x) for x in number.findall(kept)], [float(x) for x in number.findall(drawn)], rtol=0, atol=0.021
    )
