"""docs/explanation/shapes.md: its example prints what it says, its pictures are the script's and show what they say."""

import cmath
import inspect
import math
import re

import numpy as np
import pytest
from pages import JOINTS, examples, what_prints

from docs.drawings.shapes_drawing import DRAWINGS, PICTURES, SHAPES
from docs.drawings.shapes_runs_drawing import (
    AT,
    GRAVITY,
    HINGE,
    PUSH,
    RADIUS,
    SPEED,
    TIP,
    edge_run,
    graham_run,
    places_run,
)
from mechanism_fmu import model
from mechanism_fmu.model.outlines import ready

PAGE = JOINTS.parent / "explanation" / "shapes.md"
TEXT = PAGE.read_text(encoding="utf-8")


def test_examples_print_what_the_page_says() -> None:
    found = examples(PAGE)
    assert found
    for program, expected in found:
        assert what_prints(program, PAGE) == expected


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_picture_is_that_of_its_script(name: str) -> None:
    """But for the last digits of its places [px], which another processor may round otherwise."""
    number = re.compile(r"-?\d+\.\d+")
    kept, drawn = (PICTURES / f"{name}.svg").read_text(encoding="utf-8"), DRAWINGS[name]()
    assert f"({name}.svg)" in TEXT
    assert number.sub("#", kept) == number.sub("#", drawn), "python -m docs.drawings.shapes_drawing"
    places = ([float(x) for x in number.findall(text)] for text in (kept, drawn))
    np.testing.assert_allclose(*places, rtol=0, atol=0.021)


def test_all_ready_outlines_are_drawn_and_told_with_their_arguments() -> None:
    names = {name for name in vars(ready) if inspect.isfunction(getattr(ready, name))}
    assert {name for name, _, _ in SHAPES} == names
    for name in names:
        (told,) = re.findall(rf"`{name}\(([^`]*)\)`", TEXT)
        assert re.findall(r"\w+", told.replace("=...", "")) == [*inspect.signature(getattr(model, name)).parameters]


def test_the_disc_leaves_where_the_page_says() -> None:
    _, events, there = edge_run()
    assert [events[0].guard, events[-1].guard] == ["top.handover", "top.force"]
    x, y = there[-1]
    assert math.hypot(x, y) == pytest.approx(RADIUS, abs=1e-9)
    assert y / RADIUS == pytest.approx((SPEED**2 + 2 * GRAVITY * RADIUS) / (3 * GRAVITY * RADIUS), rel=1e-8)


def test_the_tooth_goes_around_both_corners_and_leaves() -> None:
    events, _ = graham_run()
    assert [event.guard for event in events] == ["entry.handover"] * 3 + ["entry.force"]


def test_the_pawl_rests_on_slope_and_face() -> None:
    """Of two forces along the normals there, the moments hold both bodies: 0.05 N m on the pawl, PUSH on the wheel."""
    tooth, shown, _ = places_run()
    hinge, tip = complex(*HINGE), complex(*HINGE) + cmath.rect(AT[0], shown["pawl"])
    rows = []
    for k in range(10):
        for element in tooth.moved(angle=shown["wheel"] + math.tau * k / 10).elements:
            way = complex(*element.chord)
            part = (tip - complex(*element.start)) / way
            if element.is_straight and 0.0 < part.real < 1.0 and abs(part.imag * way) == pytest.approx(TIP, abs=1e-8):
                foot = complex(*element.start) + part.real * way
                normal = (tip - foot) / TIP
                rows.append([((foot - hinge).conjugate() * normal).imag, -(foot.conjugate() * normal).imag])
    forces = np.linalg.solve(np.transpose(rows), [-0.05, -PUSH])
    assert sorted(forces) == pytest.approx(sorted([shown["force_1"], shown["force_2"]]), rel=1e-6)


def test_what_it_links_to_is_there() -> None:
    targets = re.findall(r"\]\(([^)#]+)", TEXT)
    assert targets
    assert not [target for target in targets if not (PAGE.parent / target).exists()]
