"""Bodies by what one knows of them: mass, centre of mass and inertia against closed forms, and where they start."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.integrate import dblquad

from mechanism_fmu.model import (
    ALUMINIUM,
    POM,
    STEEL,
    Body,
    CircularHole,
    End,
    Mechanism,
    MechanismError,
    Model,
    Revolute,
    Section,
    bar,
    compile_mechanism,
    disc,
    four_bar_points,
    length_parameter,
    mass_parameter,
    plate,
    rigid_body,
)
from mechanism_fmu.model.areas import polygon
from mechanism_fmu.model.trace import trace

STEEL_OF_10_MM = {"thickness": "10 mm", "material": STEEL}
RECTANGLE = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.2), (0.0, 0.2)]


def test_a_bar_of_known_mass() -> None:
    rod = bar("rod", (1.0, 2.0), (1.0, 2.5), mass="600 g", speed=3.0)
    assert rod.mass == 0.6
    assert rod.inertia == pytest.approx(0.6 * 0.5**2 / 12, rel=1e-15)
    assert rod.start == pytest.approx((1.0, 2.25, math.pi / 2), rel=1e-15)
    assert rod.start_rate == pytest.approx((-0.75, 0.0, 3.0), abs=1e-15)  # about a, which rests
    assert rod.a == End("rod", (-0.25, 0.0))
    assert rod.b == End("rod", (0.25, 0.0))


def test_a_bar_of_a_section_weighs_as_the_plate_of_the_same_shape() -> None:
    rod = bar("x", (0.0, 0.0), (0.3, 0.0), section=Section.rectangle(0.01, 0.2), material=STEEL)
    same = plate("x", RECTANGLE, **STEEL_OF_10_MM)
    assert (rod.mass, rod.inertia) == pytest.approx((same.mass, same.inertia), rel=1e-14)
    assert rod.mass == pytest.approx(7850 * 0.3 * 0.2 * 0.01, rel=1e-14)
    assert rod.inertia == pytest.approx(rod.mass * (0.3**2 + 0.2**2) / 12, rel=1e-14)


def test_a_bar_by_length_and_angle() -> None:
    rod = bar("rod", (1.0, 2.0), length="50 cm", angle="90 deg", mass=1.0)
    assert rod.start == (pytest.approx(1.0, abs=1e-16), 2.25, math.pi / 2)
    assert rod.b == End("rod", (0.25, 0.0))


def test_a_bar_that_the_sketch_shows_too_short() -> None:
    rod = bar("rod", (0.0, 0.0), (0.1, 0.0), length="20 cm", mass=1.0, centre=("5 cm", 0.0), inertia=2.0)
    assert rod.b == End("rod", (0.15000000000000002, 0.0))
    assert rod.start == (0.05, 0.0, 0.0)
    assert rod.inertia == 2.0


def test_a_plate_with_holes() -> None:
    """A rectangle with a round hole and a square one, by Steiner's theorem."""
    holes = (CircularHole((0.1, 0.1), 0.05), [(0.2, 0.05), (0.25, 0.05), (0.25, 0.1), (0.2, 0.1)])
    found = plate("x", RECTANGLE, holes=holes, **STEEL_OF_10_MM)
    parts = [  # area, centre, polar moment about the own centre over the area
        (0.06, np.array([0.15, 0.1]), (0.3**2 + 0.2**2) / 12),
        (-math.pi * 0.05**2, np.array([0.1, 0.1]), 0.05**2 / 2),
        (-(0.05**2), np.array([0.225, 0.075]), 0.05**2 / 6),
    ]
    area = sum(part[0] for part in parts)
    centre = sum(part[0] * part[1] for part in parts) / area
    polar = sum(part[0] * (part[2] + np.sum((part[1] - centre) ** 2)) for part in parts)
    assert found.mass == pytest.approx(78.5 * area, rel=1e-14)
    assert found.centre == pytest.approx(centre, rel=1e-14)
    assert found.inertia == pytest.approx(78.5 * polar, rel=1e-13)
    assert found.corners[2] == End("x", (0.3 - found.centre[0], 0.2 - found.centre[1]))


def test_moments_of_a_triangle_by_numerical_integration() -> None:
    def integral(of):  # over the triangle (0, 0), (2, 0), (0, 1)
        return dblquad(lambda y, x: of(x, y), 0.0, 2.0, 0.0, lambda x: 1.0 - x / 2)[0]

    found = polygon([(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)])
    assert found.area == pytest.approx(integral(lambda x, y: 1.0), rel=1e-12)
    assert found.first == pytest.approx((integral(lambda x, y: x), integral(lambda x, y: y)), rel=1e-12)
    assert found.polar == pytest.approx(integral(lambda x, y: x * x + y * y), rel=1e-12)


def test_a_disc_and_a_ring() -> None:
    wheel = disc("wheel", (1.0, 2.0), radius="100 mm", thickness=0.02, material=ALUMINIUM)
    assert wheel.mass == pytest.approx(2700 * math.pi * 0.1**2 * 0.02, rel=1e-15)
    assert wheel.inertia == pytest.approx(wheel.mass * 0.1**2 / 2, rel=1e-15)
    assert (wheel.start, wheel.radius) == ((1.0, 2.0, 0.0), 0.1)
    ring = disc("ring", radius=0.1, bore=0.08, mass=3.0)
    assert ring.inertia == pytest.approx(3.0 * (0.1**2 + 0.08**2) / 2, rel=1e-15)
    turned = [(0.1 * math.cos(k * math.pi / 500), 0.1 * math.sin(k * math.pi / 500)) for k in range(1000)]
    near = plate("x", turned, mass=wheel.mass)
    assert near.inertia == pytest.approx(wheel.inertia, rel=1e-5)  # of a polygon of 1000 sides: 1 - 1.3e-5 ... 0.7e-5


COORDINATE = st.floats(-2.0, 2.0)


@given(st.lists(st.floats(0.2, 2.0), min_size=3, max_size=9), COORDINATE, COORDINATE)
def test_a_plate_is_the_sum_of_its_triangles(radii: list[float], x: float, y: float) -> None:
    """Triangles from a point that sees all corners."""
    angles = [2 * math.pi * k / len(radii) for k in range(len(radii))]
    corners = [(x + r * math.cos(a), y + r * math.sin(a)) for r, a in zip(radii, angles, strict=True)]
    if len(radii) == 3:
        corners.insert(1, ((corners[0][0] + corners[1][0]) / 2, (corners[0][1] + corners[1][1]) / 2))
    found = polygon(corners)
    triangles = [polygon([(x, y), a, b]) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    assert found.area == pytest.approx(sum(t.area for t in triangles), rel=1e-12)
    for k in range(2):
        assert found.first[k] == pytest.approx(sum(t.first[k] for t in triangles), rel=1e-11, abs=1e-12)
    assert found.polar == pytest.approx(sum(t.polar for t in triangles), rel=1e-12)


@given(COORDINATE, COORDINATE, st.floats(-3.0, 3.0), st.booleans())
def test_where_a_plate_is_drawn_does_not_matter(x: float, y: float, angle: float, backwards: bool) -> None:
    """Moved, turned and listed the other way round, it has the same mass and inertia, and its centre goes along."""
    shape = [(0.0, 0.0), (0.3, 0.0), (0.1, 0.1), (0.0, 0.25)]
    hole = CircularHole((0.06, 0.06), 0.03)
    c, s = math.cos(angle), math.sin(angle)

    def moved(point):
        return (100 * x + c * point[0] - s * point[1], 100 * y + s * point[0] + c * point[1])

    corners = [moved(corner) for corner in shape]
    here = plate("x", shape, holes=[hole], mass=2.0)
    there = plate(
        "x", corners[::-1] if backwards else corners, holes=[CircularHole(moved(hole.centre), 0.03)], mass=2.0
    )
    assert there.inertia == pytest.approx(here.inertia, rel=1e-10)
    assert there.centre == pytest.approx(moved(here.centre), abs=1e-11)


@given(COORDINATE, COORDINATE, st.floats(-3.0, 3.0), COORDINATE, COORDINATE)
def test_at_is_where_it_was_drawn(x: float, y: float, angle: float, u: float, v: float) -> None:
    """A point of the frame is at the start where the frame's place and angle put it, whatever the centre of mass."""
    block = rigid_body("x", (x, y), angle=angle, mass=1.0, inertia=1.0, centre=(0.3, -0.2), velocity=(u, v), speed=2.0)
    a, b = block.at(0.5, 0.25).point
    x_centre, y_centre, phi = block.start
    c, s = math.cos(angle), math.sin(angle)
    assert phi == angle
    assert x_centre + c * a - s * b == pytest.approx(x + c * 0.5 - s * 0.25, abs=1e-14)
    assert y_centre + s * a + c * b == pytest.approx(y + s * 0.5 + c * 0.25, abs=1e-14)
    # the origin of the frame moves with `velocity`
    origin = block.at(0.0, 0.0).point
    dx, dy = c * origin[0] - s * origin[1], s * origin[0] + c * origin[1]
    rates = block.start_rate
    assert (rates[0] - 2.0 * dy, rates[1] + 2.0 * dx) == pytest.approx((u, v), abs=1e-14)


def test_sizes_may_be_parameters() -> None:
    """The same numbers, traced and not: no solid looks at a value."""

    def mechanism(values: SimpleNamespace) -> Mechanism:
        size = values.size
        rod = bar("rod", (0.0, 0.0), (size, size), mass=values.mass)
        wedge = plate("wedge", [(0.0, 0.0), (0.0, size), (size, 0.0)], thickness=size, material=POM, at=(size, size))
        wheel = disc("wheel", (0.0, size), radius=size, bore=size / 2, mass=values.mass)
        pins = four_bar_points((0, 0), (0.2, 0), crank=size, coupler=0.2, rocker=0.2, angle=size, branch="crossed")
        link = bar("link", pins.crank_pin, pins.rocker_pin, mass=1.0)
        joints = (
            Revolute("a", rod.b, wedge.at(0.0, 0.0)),
            Revolute("b", wedge.at(size, 0.0), wheel),
            Revolute("c", rod.a, link.b),
        )
        return Mechanism((rod, wedge, wheel, link), joints=joints)

    parameters = (length_parameter("size", "50 mm", ""), mass_parameter("mass", "2 kg", ""))
    model = Model("Solids", "", parameters, mechanism)
    traced = trace(model)
    values = SimpleNamespace(size=0.07, mass=1.3)
    expected = compile_mechanism(model.mechanism(values)).columns
    for name, table in traced.evaluate(values).columns.items():
        np.testing.assert_array_equal(table, expected[name], err_msg=name)


def test_numbers_of_a_body_may_be_texts_with_units() -> None:
    texts = Body("x", "20 g", "2 kg.m2", ("1 mm", 0.5, "180 deg"), ("1 mm/s", 0, 0), "5 mm")
    assert texts == Body("x", 0.02, 2.0, (0.001, 0.5, math.pi), (0.001, 0, 0), 0.005)
    assert bar("x", (0, 0), (1, 0), mass=1, tooth_length="5 mm").tooth_length == 0.005
    assert Mechanism((texts,), gravity=(0.0, "-981 cm/s2")).gravity == (0.0, -9.81)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: bar("x", (0, 0), (1, 0)), "bar 'x': give its mass, or else section and material"),
        (lambda: bar("x", (0, 0), (1, 0), mass=1, section=Section(1, 1, 1), material=STEEL), "bar 'x': give its mass,"),
        (lambda: bar("x", (0, 0), (1, 0), section=Section(1, 1, 1)), "bar 'x': give its mass,"),
        (lambda: bar("x", (0, 0), mass=1, length=1), "bar 'x': say where it ends, by b, or else by length and angle"),
        (lambda: bar("x", (0, 0), (1, 0), mass=1, angle=1), "bar 'x': say where it ends, by b, or else"),
        (lambda: bar("x", (0, 0), 1, mass=1), r"bar 'x': b is 1, but it must be a point \(x, y\)"),
        (lambda: bar("x", (0, 0), (1, 0), mass="5 mm"), "bar 'x': mass wants kg, got '5 mm'"),
        (lambda: plate("x", RECTANGLE, thickness=1), "plate 'x': give its mass, or else thickness and material"),
        (lambda: plate("x", RECTANGLE[:2], mass=1), "plate 'x': outline has 2 corners, but it takes at least 3"),
        (lambda: plate("x", [(0, 0), (1, 1), (2, 2)], mass=1), "plate 'x' has an area of 0 m2, but it must be pos"),
        (lambda: plate("x", RECTANGLE, holes=[CircularHole((0, 0), 1)], mass=1), "has an area of -3.08159 m2"),
        (lambda: disc("x", radius="5 kg", mass=1), "disc 'x': radius wants m, got '5 kg'"),
        (lambda: rigid_body("x", mass=1, inertia=1, angle="5 m"), "rigid_body 'x': angle wants rad, got '5 m'"),
        (
            lambda: disc("x", radius=0.1, bore=0.2, mass=1),
            "disc 'x': bore = 0.2 m, but it must not be negative, and less",
        ),
        (lambda: disc("x", radius=0.1, bore=-0.05, mass=1), "disc 'x': bore = -0.05 m, but it must not be negative"),
        (lambda: disc("x", radius=-0.1, mass=1), "disc 'x': radius = -0.1 m, but it must be finite and positive"),
        (lambda: disc("x", radius=math.nan, mass=1), "disc 'x': radius = nan m"),
        (lambda: bar("x", (0, 0), length=-1, angle=0, mass=1), "bar 'x': length = -1 m, but it must be finite and not"),
        (lambda: bar("x", (0, 0), (1, 0), mass=1, velocity=3.0), r"bar 'x': velocity is 3.0, but it must be a vector"),
        (lambda: bar("x", (0, 0), (1, 0), mass=1, tooth_length="5 kg"), "Body 'x': tooth_length wants m, got '5 kg'"),
        (lambda: Body("x", "1 kg", "2 kg"), r"Body 'x': inertia wants kg.m2, got '2 kg'"),
        (
            lambda: Body("x", 1, 2, ("1 mm", 0)),
            r"Body 'x': start is \('1 mm', 0\), but it must be 3 numbers, in m, m, rad",
        ),
    ],
)
def test_what_is_refused(make, said: str) -> None:
    with pytest.raises(MechanismError, match=said):
        make()
