"""The pages of force elements and contacts say what is true, and what their classes say."""

import inspect
import itertools
import re
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
from pages import examples, what_prints

from docs.elements.described import arguments, unit
from docs.elements.drawings import DRAWINGS
from docs.elements.tables import PAGES as FOLDER, TABLE, table
from mechanism_fmu import model
from mechanism_fmu.model import GROUND, Input, Mechanism, Output, rigid_body
from mechanism_fmu.model.forces import ForceElement
from mechanism_fmu.simulation import Simulation

PAGES = sorted(FOLDER.glob("*.md"))
OVERVIEW = FOLDER / "README.md"
ELEMENTS = get_args(ForceElement)
PLAY = (model.ClearanceJoint, model.SlotClearanceJoint)
CONTACTS = (model.PointLineContact, model.OutlineContact, *PLAY, model.AngleStop, model.AngleLock)
PARTS = (*ELEMENTS, *CONTACTS, model.CircularPattern, model.LogicalFunction)
STEPS = ["**For**", "**Law**", "**Inputs**", "**Outputs**", "**Energy**"]
#: What has no default, of the classes that have such fields.
NEEDED = {
    model.NonlinearSpring: {"law": lambda x, v: x + v},
    model.NonlinearTorsionSpring: {"law": lambda x, v: x + v},
    model.AngleStop: {"angle": 0.1, "pitch": 0.2},
    model.AngleLock: {"angle": 0.1, "pitch": 0.2, "closed_while": "f"},
    model.ClearanceJoint: {"pin_radius": 0.1, "clearance": 0.01},
    model.SlotClearanceJoint: {"pin_radius": 0.1, "clearance": 0.01, "travel": 0.2},
    model.CircularPattern: {"pitch": 0.2},
    model.OutlineContact: {"outline_i": model.Outline.circle(0.1), "outline_j": model.Outline.circle(0.2, (1.0, 0.0))},
}
by_name = pytest.mark.parametrize("part", PARTS, ids=lambda part: part.__name__)
by_page = pytest.mark.parametrize("page", [page for page in PAGES if page != OVERVIEW], ids=lambda page: page.stem)


def pages_of(part):
    """The pages whose tables are of a class."""
    mark = f"<!-- fields of {part.__name__} -->"
    return [page for page in PAGES if mark in page.read_text(encoding="utf-8")]


def made(part, first, second, **numbers):
    """A part between two bodies."""
    ends = []
    for slot, body in zip(part.slots, (first, second), strict=False):
        line = slot.direction is not None
        ends.append(body.line((0.0, 0.1), (1.0, 0.0)) if line else body.at(0.1, 0.2) if slot.point else body)
    return part("part", *ends, **(NEEDED.get(part, {}) | numbers))


@pytest.mark.parametrize(
    ("page", "program", "printed"),
    [
        pytest.param(page, program, printed, id=f"{page.stem}-{number}")
        for page in PAGES
        for number, (program, printed) in enumerate(examples(page), start=1)
    ],
)
def test_an_example_prints_what_its_page_says(page, program, printed):
    assert what_prints(program, page) == printed


@by_name
def test_a_part_has_one_page_with_an_example_of_it_which_the_overview_names(part):
    (page,) = pages_of(part)
    assert any(re.search(rf"\b{part.__name__}\(", program) for program, _ in examples(page))
    overview = OVERVIEW.read_text(encoding="utf-8")
    assert any(f"`{part.__name__}`" in line and f"({page.name})" in line for line in overview.splitlines())


@by_name
def test_a_page_names_the_arguments_of_its_part_with_their_defaults(part):
    (page,) = pages_of(part)
    (shown,) = re.findall(rf"`{part.__name__}\((name[^`]*)\)`", page.read_text(encoding="utf-8"))
    parts = [text.partition("=") for text in re.split(r",\s(?=[a-z])", shown)]
    expected = []
    for argument in inspect.signature(part).parameters.values():
        default = "" if argument.default is argument.empty else repr(argument.default).replace("'", '"')
        expected.append((argument.name, "GROUND" if default == '"ground"' else default))
    assert [(name, default) for name, _, default in parts] == expected


@by_page
def test_a_page_has_the_five_steps_traps_and_a_drawing(page):
    text = page.read_text(encoding="utf-8")
    assert re.findall(r"^\d\. (\*\*\S+\*\*)", text, re.MULTILINE) == STEPS
    assert "## Traps" in text
    assert f"({page.stem}.svg)" in text
    assert page.stem in DRAWINGS


@by_page
def test_the_tables_of_a_page_are_those_of_the_classes(page):
    tables = [(what, name, text) for _, what, name, text, _ in TABLE.findall(page.read_text(encoding="utf-8"))]
    assert tables
    for what, name, text in tables:
        assert text == table(what, name), "python -m docs.elements.tables"
    for part in PARTS:
        if page in pages_of(part):
            readable = getattr(part, "quantities", {}) or getattr(part, "readings", ()) or part is model.CircularPattern
            assert (("outputs", part.__name__) in [found[:2] for found in tables]) == bool(readable)


@by_name
def test_a_page_names_the_targets_of_inputs_and_no_others(part):
    (page,) = pages_of(part)
    (said,) = re.findall(r"^3\. \*\*Inputs\*\*:(.*?)^4\. ", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    of_page = {entry for other in ELEMENTS if page in pages_of(other) for entry in other.writable}
    assert set(re.findall(r"`<name>\.(\w+)`", said)) == of_page


@by_name
def test_a_docstring_names_each_field_with_the_unit_that_the_class_has(part):
    said = arguments(part)
    units = {**getattr(part, "units", {}), **getattr(part, "positive", {}), **getattr(part, "not_negative", {})}
    for name in inspect.signature(part).parameters:
        assert name in said
    for name, expected in units.items():
        stated = (unit(said[name]) or "").split(".=.")[0]
        assert stated == expected, name


@by_name
def test_a_limit_of_a_table_is_what_is_refused(part):
    """Below it a number is refused; 0 only where the limit is > 0; and what has no limit may be negative."""
    if part is model.LogicalFunction:
        return
    first, second = rigid_body("a", (0, 0), mass=1.0, inertia=1.0), rigid_body("b", (1, 0), mass=1.0, inertia=1.0)
    good = made(part, first, second, **dict.fromkeys(getattr(part, "positive", {}), 1.0))
    (page,) = pages_of(part)
    rows = re.findall(rf"<!-- fields of {part.__name__} -->\n(.*?)<!-- end -->", page.read_text("utf-8"), re.DOTALL)[0]
    for name, limit in re.findall(r"^\| `(\w+)` \|[^|]*\|[^|]*\|([^|]*)\|", rows, re.MULTILINE):
        value = getattr(good, name)
        if name == "pitch" and part is model.CircularPattern:
            continue  # any number but 0
        if not isinstance(value, float) and name != "pitch":
            continue

        def refused(number, name=name):
            return any(finding.applies > 0 for finding in replace(good, **{name: number}).findings())

        assert refused(-1.0) == bool(limit.strip()), name
        assert refused(0.0) == (limit.strip() == "> 0"), name
        assert refused(2.0) == (limit.strip() == "0 … 1"), name


WITH_INPUTS = [(part, quantity) for part in ELEMENTS if part.writable for quantity in part.quantities]


@pytest.mark.parametrize(("part", "quantity"), WITH_INPUTS, ids=lambda x: getattr(x, "__name__", x))
def test_what_depends_at_once_on_an_input_is_what_the_table_lists(part, quantity):
    """Each input is changed without moving time; what changes must be listed, and what is listed changes."""
    first = rigid_body("a", (0, 0), mass=1.0, inertia=1.0, angle=0.3, speed=1.0, velocity=(0.4, 0.5))
    second = rigid_body("b", (1, 0), mass=1.0, inertia=1.0, angle=-0.2, speed=-0.3)
    numbers = {"voltage": 1e3, "gain": 1.0, "integral_gain": 1.0, "limit": 0.1, "stiffness": 2.0, "damping": 3.0}
    known = inspect.signature(part).parameters
    element = made(part, first, second, **{name: value for name, value in numbers.items() if name in known})
    inputs = tuple(Input(entry, f"part.{entry}", 0.1, "An entry") for entry in part.writable)
    outputs = (Output("value", f"part.{quantity}", "Read", part.quantities[quantity].unit),)
    simulation = Simulation(Mechanism((first, second), forces=(element,), inputs=inputs, outputs=outputs))
    simulation.advance(0.05)
    found = set()
    for entry in part.writable:
        # Of values of its own and of the others: a limit shows only where it is reached, a speed only where it is not.
        for others, low, high in itertools.product((0.1, 90.0), (0.1, 0.2), (0.2, 50.0)):
            values = []
            for value in (low, high):
                for other in part.writable:
                    simulation.set_input(other, value if other == entry else others)
                simulation.advance(simulation.time)
                values.append(simulation.read()["value"])
            if abs(values[1] - values[0]) > 1e-6:  # below, the change from the dense output to a true step
                found.add(entry)
    assert found == set(part.quantities[quantity].feedthrough)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_points_to_is_there(page):
    text = page.read_text(encoding="utf-8")
    targets = re.findall(r"\]\(([^)#]+)", text) + re.findall(r'src="([^"]+)"', text)
    assert not [target for target in targets if not (page.parent / target).exists()]


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_drawing_is_that_of_its_script(name):
    """But for the last digit of its numbers [px], which another processor may round otherwise."""
    number = re.compile(r"-?\d+\.\d+")
    kept, drawn = (FOLDER / f"{name}.svg").read_text(encoding="utf-8"), DRAWINGS[name]()
    assert number.sub("#", kept) == number.sub("#", drawn), "python -m docs.elements.drawings"
    np.testing.assert_allclose(
        [float(x) for x in number.findall(kept)], [float(x) for x in number.findall(drawn)], rtol=0, atol=0.021
    )


def test_the_table_of_the_overview_has_every_page():
    linked = re.findall(r"^\| \[.*?\]\((\w+\.md)\)", OVERVIEW.read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(linked) == [page.name for page in PAGES if page != OVERVIEW]
    assert GROUND == "ground"  # as the pages write it
