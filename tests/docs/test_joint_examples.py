"""The pages of the joint library say what is true."""

import contextlib
import io
import re

import pytest
from pages import JOINTS, PAGES, examples

from mechanism_fmu.model import joints

EXAMPLES = [
    pytest.param(page, program, printed, id=f"{page.stem}-{number}")
    for page in PAGES
    for number, (program, printed) in enumerate(examples(page), start=1)
]
CLASSES = [name for name in joints.__all__ if isinstance(getattr(joints, name), type)]
OVERVIEW = JOINTS / "README.md"
#: Each page of joints states them in this order.
STEPS = ["**Allows**", "**Φ**", "**Φ_q**", "**ν**", "**γ**"]


@pytest.mark.parametrize(("page", "program", "printed"), EXAMPLES)
def test_an_example_prints_what_its_page_says(page, program, printed):
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        exec(compile(program, page.name, "exec"), {"__name__": page.stem})
    assert text.getvalue() == printed


def pages_of(name):
    return [page for page in PAGES if page != OVERVIEW and re.search(rf"`{name}\b", page.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("name", CLASSES)
def test_every_joint_has_a_page_with_an_example_of_it(name):
    shown = [page for page in pages_of(name) if any(re.search(rf"\b{name}\(", program) for program, _ in examples(page))]
    assert shown, f"{name} is in no page of docs/joints that shows it at work"
    assert any(f"({page.name})" in OVERVIEW.read_text(encoding="utf-8") for page in shown)


@pytest.mark.parametrize("name", CLASSES)
def test_a_page_names_the_arguments_of_its_joint(name):
    """Those that a joint is made from, in their order, where the page shows them."""
    fields = list(getattr(joints, name).__dataclass_fields__)
    for page in pages_of(name):
        for shown in re.findall(rf"`{name}\(([^`]*)\)`", page.read_text(encoding="utf-8")):
            named = [argument.split("=")[0] for argument in re.split(r",\s(?=[a-z])", shown)]
            assert named == fields


@pytest.mark.parametrize("page", [page for page in PAGES if page.stem not in ("README", "profiles")], ids=lambda p: p.stem)
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
