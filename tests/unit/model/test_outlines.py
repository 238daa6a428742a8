"""Outlines: areas in closed form and against many small edges, corners, images, SVG paths, and what is refused."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, given, strategies as st

from mechanism_fmu.model import (
    STEEL,
    MechanismError,
    Outline,
    Parameter,
    disc,
    from_svg_path,
    plate,
    svg_path,
)
from mechanism_fmu.model.areas import polygon
from tests.outlines_apart import Pose, is_inside, placed

SQUARE = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)]


@st.composite
def rounds(draw: st.DrawFn) -> Outline:
    """Closed outlines around the origin whose elements do not cross, with bulges both ways."""
    count = draw(st.integers(3, 7))
    radii = draw(st.lists(st.floats(0.5, 1.5), min_size=count, max_size=count))
    bulges = draw(st.lists(st.sampled_from((0.0, 0.1, 0.25, -0.1, -0.05)), min_size=count, max_size=count))
    turns = [math.tau * k / count for k in range(count)]
    return Outline(tuple((r * math.cos(t), r * math.sin(t), b) for r, t, b in zip(radii, turns, bulges, strict=True)))


def edges(outline: Outline, parts: int) -> list[tuple[float, float]]:
    return [element.point(k / parts) for element in outline.elements for k in range(parts)]


@given(rounds())
def test_moments_are_those_of_many_small_edges(outline: Outline) -> None:
    """Whose error falls with the square of their number: two numbers of edges tell what infinitely many would give."""
    coarse, fine = (np.hstack([a.area, a.first, a.polar]) for a in (polygon(edges(outline, n)) for n in (128, 256)))
    found = outline.area()
    expected = fine + (fine - coarse) / 3.0
    assert np.hstack([found.area, found.first, found.polar]) == pytest.approx(expected, abs=2e-9)


@pytest.mark.parametrize("bulge", [*(10.0**-k for k in range(1, 13)), 0.2, 0.2499, 0.2501, 0.3, 1.0, 1.7])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_flat_arcs_keep_all_digits(bulge: float, sign: float) -> None:
    """Of a segment beside a chord of 1, against the closed forms in a hundred digits."""
    from mpmath import atan, cos, mp, mpf, sin

    mp.dps = 100
    b = mpf(bulge)
    a, r = 2 * atan(b), (1 + b * b) / (4 * b)
    h = r * cos(a)

    shape = Outline(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)))
    round_one = Outline(((0.0, 0.0, sign * bulge), *shape.vertices[1:]))
    area = float(r * r * (a - sin(a) * cos(a)))
    first = float(r**3 * sin(a) ** 3 * 2 / 3 - h * r * r * (a - sin(a) * cos(a)))
    about = float(
        r**4 * (a / 2 - sin(a) * cos(a) ** 3 / 2 - sin(a) ** 3 * cos(a) / 6)
        - 2 * h * r**3 * sin(a) ** 3 * 2 / 3
        + h**2 * r**2 * (a - sin(a) * cos(a))
    )
    more, less = round_one.area(), shape.area()
    scale = max(1.0, bulge**3)
    assert more.area - less.area == pytest.approx(sign * area, rel=1e-14, abs=4e-16 * scale)
    assert more.first[1] - less.first[1] == pytest.approx(-first, rel=1e-13, abs=4e-16 * scale)
    # seen from the origin: the middle of the chord is at (1/2, 0)
    assert more.polar - less.polar == pytest.approx(sign * (about + area / 4), rel=1e-13, abs=8e-16 * scale)


def test_a_circle_is_that_of_its_radius() -> None:
    area, hole = (Outline.circle(0.5, (1.0, 2.0), hole=hole).area() for hole in (False, True))
    assert area.area == pytest.approx(math.pi / 4, rel=1e-15)
    assert area.first == pytest.approx((math.pi / 4, math.pi / 2), rel=1e-15)
    assert area.polar == pytest.approx(math.pi / 4 * (5.0 + 0.125), rel=1e-15)
    assert np.hstack([hole.area, hole.first, hole.polar]) == pytest.approx(
        np.hstack([area.area, area.first, area.polar]), rel=1e-15
    )


def test_rounded_corners_take_away_what_they_must() -> None:
    """(4 - pi)/4 r^2 at each right angle; a radius of zero leaves the corner."""
    rounded = Outline.polygon(SQUARE, corner_radius=["20 mm", 0.0, 0.01, 0.03])
    assert len(rounded.vertices) == 7
    taken = (1.0 - math.pi / 4) * (0.02**2 + 0.01**2 + 0.03**2)
    assert rounded.area().area == pytest.approx(0.02 - taken, rel=1e-14)
    for element in rounded.elements:
        if not element.is_straight:
            assert abs(element.radius) in [pytest.approx(r, rel=1e-12) for r in (0.02, 0.01, 0.03)]
    tangents = [element.tangents() for element in rounded.elements]
    smooth = [math.dist(tangents[k - 1][1], tangents[k][0]) for k in range(len(tangents))]
    assert sum(jump < 1e-12 for jump in smooth) == 6  # and one corner is sharp


def test_a_hollow_corner_is_rounded_to_its_other_side() -> None:
    ell = Outline.polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], corner_radius=[0, 0, 0, 0.2, 0, 0])
    assert ell.area().area == pytest.approx(3.0 + (1.0 - math.pi / 4) * 0.04, rel=1e-14)
    assert [element.bulge < 0 for element in ell.elements].count(True) == 1


def test_ends_of_a_chain_stay() -> None:
    chain = Outline.chain([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)], corner_radius=0.1)
    assert (chain.points[0], chain.points[-1], len(chain.elements)) == ((0.0, 0.0), (1.0, 1.0), 3)


@given(rounds(), st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))
def test_moved_and_mirrored_outlines_have_the_same_area(outline: Outline, x: float, y: float, angle: float) -> None:
    area, moved, mirrored = outline.area(), outline.moved(x, y, angle).area(), outline.mirrored().area()
    assert moved.area == pytest.approx(area.area, rel=1e-12)
    c, s = math.cos(angle), math.sin(angle)
    (u, v) = area.first
    assert moved.first == pytest.approx((x * area.area + c * u - s * v, y * area.area + s * u + c * v), abs=1e-12)
    assert mirrored.area == pytest.approx(area.area, rel=1e-12)
    assert mirrored.first == pytest.approx((u, -v), abs=1e-12)


@given(rounds(), st.floats(-2, 2), st.floats(-2, 2))
def test_the_mirror_image_has_the_mirrored_points(outline: Outline, x: float, y: float) -> None:
    point = complex(x, y)
    assume(min(abs(point - element.nearest(point)) for element in placed(outline, Pose())) > 1e-9)
    assert is_inside(outline, Pose(), point) == is_inside(outline.mirrored(), Pose(), complex(x, -y))


@given(rounds())
def test_a_path_comes_back(outline: Outline) -> None:
    back = from_svg_path(svg_path(outline))
    assert np.array(back.vertices) == pytest.approx(np.array(outline.vertices), abs=1e-12)
    assert back.closed


def test_paths_of_drawing_programs() -> None:
    """Relative commands, lines along the axes, numbers without separators, arcs of both kinds, millimetres."""
    plain = from_svg_path("m10-10 h20v-10h-20z")
    assert np.array(plain.points) == pytest.approx(np.array([(0.01, 0.01), (0.03, 0.01), (0.03, 0.02), (0.01, 0.02)]))
    assert plain.area().area == pytest.approx(2e-4)
    slot = from_svg_path("M 0,0 L 20,0 A 5 5 0 0 0 20 -10 L 0,-10 A 5 5 0 0 0 0 0 Z")
    assert slot.area().area == pytest.approx(2e-4 + math.pi * 25e-6)
    assert svg_path(Outline.circle(0.5)) == "M 500,0 A 500 500 0 0 0 -500,0 A 500 500 0 0 0 500,0 Z"
    large = from_svg_path("M 5 0 A 5 5 0 1 0 0 5 Z")  # three quarters of a circle, and its chord
    assert large.area().area == pytest.approx((0.75 * math.pi + 0.5) * 25e-6)
    assert from_svg_path("M 0 0 A 0 5 0 0 1 10 0").elements[0].is_straight
    with pytest.raises(MechanismError, match="scale = 0, but it must be positive"):
        from_svg_path("M 0 0 L 1 1", 0.0)
    open_chain = from_svg_path("M 0 0 L 10 0")
    assert (open_chain.closed, svg_path(open_chain)) == (False, "M 0,0 L 10,0")


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("M 0 0 C 1 1 2 2 3 3", "has 'C'; it may have M, L, H, V, A, Z"),
        ("M 0 0 L 1", "command L needs 2 numbers, but has 1"),
        ("M 0 0 A 5 3 0 0 1 1 1", "ellipse, with radii 5 and 3"),
        ("M 0 0 L 1 1 M 2 2", "second M"),
        ("M 0 0 A 5 5 0 1 0 0 0 Z", "ends where it begins"),
        ("M 0 0 A 5 5 0 015 5 1 1", "flags 15 and 5"),
        ("M 0 0 L 1 1 Z 3 3", "behind Z"),
        ("0 0", "a number before its first letter"),
        ("M 0 0 L 1 ?", "'\\?', which is neither a letter nor a number"),
    ],
)
def test_paths_that_cannot_be_are_refused(path: str, message: str) -> None:
    with pytest.raises(MechanismError, match=message):
        from_svg_path(path)


def test_a_plate_of_an_outline_weighs_what_its_area_does() -> None:
    round_hole = Outline.circle("10 mm", (0.1, 0.05), hole=True)
    body = plate("p", Outline.polygon(SQUARE, "20 mm"), thickness="5 mm", material=STEEL, holes=[round_hole])
    area = 0.02 - (4 - math.pi) * 0.02**2 - math.pi * 0.01**2
    assert body.mass == pytest.approx(7850.0 * 0.005 * area, rel=1e-14)
    assert body.centre == pytest.approx((0.1, 0.05), abs=1e-15)
    assert plate("p", Outline.polygon(SQUARE), mass=2.0).inertia == pytest.approx(2.0 * (0.2**2 + 0.1**2) / 12)
    wheel = plate("w", Outline.circle(0.3), mass=2.0)
    assert wheel.inertia == pytest.approx(disc("w", radius=0.3, mass=2.0).inertia, rel=1e-14)
    assert len(wheel.corners) == 24


def test_dimensions_may_be_parameters() -> None:
    """As symbolic numbers pass: what was traced gives the same mass as plain numbers."""
    from mechanism_fmu.model import GROUND, Mechanism, Model, Revolute
    from mechanism_fmu.model.trace import trace

    def mechanism(values: SimpleNamespace) -> Mechanism:
        corners = [(0.0, 0.0), (values.length, 0.0), (values.length, 0.1), (0.0, 0.1)]
        body = plate("p", Outline.polygon(corners, values.fillet), thickness=0.005, material=STEEL)
        return Mechanism((body,), (Revolute("pin", GROUND.at(0.0, 0.0), body.at(0.0, 0.0)),), gravity=(0.0, -9.81))

    model = Model(
        "Plate",
        "A plate on a pin",
        (
            Parameter("length", 0.2, "Its length", "m", 0.05, 1.0),
            Parameter("fillet", 0.02, "Radius of its corners", "m", 0.001, 0.02),
        ),
        mechanism,
    )
    values = model.values(length=0.3, fillet=0.01)
    expected = 7850.0 * 0.005 * (0.03 - (4 - math.pi) * 1e-4)
    assert model.build(values).bodies[0].mass == pytest.approx(expected, rel=1e-13)
    inverse = trace(model).evaluate(values).columns["inverse_mass"][0]
    assert 1.0 / inverse == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Outline.polygon(SQUARE[:2]), "at least 3 points, this has 2"),
        (lambda: Outline.chain(SQUARE[:1]), "at least 2 points, this has 1"),
        (lambda: Outline.polygon([*SQUARE, SQUARE[-1]], 0.01), r"Two points of an outline are the same, \(0, 0.1\)"),
        (lambda: Outline.polygon(SQUARE, [0.01, 0.02]), "corner_radius has 2 radii for 4 points"),
        (lambda: Outline(((0.0, 0.0, 0.0),)), "at least 2 elements, this has 1"),
        (lambda: Outline(((0.0, 0.0, 0.0),), closed=False), "at least 1 elements, this has 0"),
        (lambda: Outline(((0, 0, 0), (1, 0, 0)), closed=False, hole=True), "a hole is closed"),
        (lambda: Outline.chain(SQUARE).area(), "An open outline has no area"),
        (lambda: plate("p", Outline.polygon(SQUARE[::-1]), mass=1.0), "runs the wrong way round.*counter-clockwise"),
        (
            lambda: plate("p", SQUARE, mass=1.0, holes=[Outline.circle(0.01, (0.1, 0.05)).mirrored()]),
            "not a hole",
        ),
        (
            lambda: plate("p", Outline(((0, 0, 0), (1, 0, 0), (1, 1e-10, 0), (0, 1, 0))), mass=1.0),
            "element 1 is 1e-10 m long, but it must be longer than 3.41421e-09 m",
        ),
    ],
)
def test_what_cannot_be_is_refused(make: object, message: str) -> None:
    with pytest.raises(MechanismError, match=message):
        make()  # type: ignore[operator]
