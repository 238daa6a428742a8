"""Ready outlines: areas in closed form, the way around, roundings, copies that join, and what is refused."""

import cmath
import math
from types import SimpleNamespace

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Mechanism,
    MechanismError,
    Model,
    Outline,
    OutlineContact,
    Parameter,
    Revolute,
    compile_mechanism,
    deadbeat_pallet,
    deg,
    escape_tooth,
    geneva_sector,
    hook,
    involute_tooth,
    pin_tooth,
    ratchet_tooth,
    recoil_pallet,
    rigid_body,
    round_hole,
    slot_hole,
)
from mechanism_fmu.model.outlines.element import Element
from mechanism_fmu.model.sawtooth import sawtooth, wheel_outline
from mechanism_fmu.model.trace import trace

RATCHET = 10, deg(90), 0.1, 1.115
GENEVA = 4, 0.1, "12.4 mm", "45 mm", "50 mm"
ESCAPE = 30, 0.030, 0.025, deg(8), deg(22)
HOOK = 0.1, 0.01, 0.012, 0.02
PALLET = "28.7 mm", "31.3 mm"
#: Open ones, of one tooth, with their number: sharp, and rounded.
TEETH = {
    "ratchet": (10, ratchet_tooth(*RATCHET)),
    "rounded ratchet": (10, ratchet_tooth(*RATCHET, tip_radius=5e-4, root_fillet="1 mm")),
    "gear": (24, involute_tooth(24, 0.002)),
    "rounded gear": (60, involute_tooth(60, "2 mm", root_fillet=4e-4, backlash=1e-4)),
    "geneva": (4, geneva_sector(*GENEVA)),
    "rounded geneva": (6, geneva_sector(6, 0.1, 0.01, 0.05, 0.03, mouth_radius=0.002)),
    "escape": (30, escape_tooth(*ESCAPE)),
    "rounded escape": (30, escape_tooth(*ESCAPE, tip_radius=1e-4, root_fillet=2e-4)),
}
CLOSED = {
    "pin": pin_tooth(12, 0.1, 0.005),
    "deadbeat entry": deadbeat_pallet(*PALLET, deg(226.5), deg(224.5), deg(216.5)),
    "deadbeat exit": deadbeat_pallet(*PALLET, deg(315.5), deg(313.5), deg(323.5)),
    "recoil": recoil_pallet((0.0, 0.0), (3e-3, 4e-3), "1 mm", corner_radius=2e-4),
    "hook": hook(*HOOK, undercut=deg(5), tip_radius=5e-4, throat_fillet="1 mm"),
    "round hole": round_hole(0.01, (0.1, 0.0)),
    "slot": slot_hole(0.1, 0.02, (0.2, 0.1), deg(30)),
}


def wheel(count: int, tooth: Outline) -> Outline:
    """The whole wheel, closed, of one tooth."""
    turned = [tooth.moved(angle=math.tau * k / count) for k in range(count)]
    return Outline(tuple(vertex for one in turned for vertex in one.vertices[:-1]))


def turns(outline: Outline) -> list[float]:
    """By what angle the way turns at each inner vertex [rad]; of a closed one, at all."""
    elements = outline.elements
    pairs = zip(elements, elements[1:] + (elements[:1] if outline.closed else ()), strict=False)
    ends = [(complex(*a.tangents()[1]), complex(*b.tangents()[0])) for a, b in pairs]
    return [cmath.phase(after / before) for before, after in ends]


@pytest.mark.parametrize("name", TEETH)
def test_copies_join_end_to_end_around_the_material(name: str) -> None:
    count, tooth = TEETH[name]
    first, last = (complex(*tooth.vertices[k][:2]) for k in (0, -1))
    assert first * cmath.rect(1.0, math.tau / count) == pytest.approx(last, rel=1e-14)
    whole = wheel(count, tooth)
    assert not [*filter(lambda finding: finding.applies > 0, whole.findings("x"))]
    total = sum(turns(whole)) + sum(0.0 if e.is_straight else e.sweep for e in whole.elements)
    assert total == pytest.approx(math.tau)  # once around, counter-clockwise


@pytest.mark.parametrize("name", [name for name in TEETH if name not in ("ratchet",)])
def test_copies_join_smoothly(name: str) -> None:
    """But a sharp root, which is a corner."""
    count, tooth = TEETH[name]
    elements = tooth.elements
    arrives, leaves = complex(*elements[-1].tangents()[1]), complex(*elements[0].tangents()[0])
    assert leaves * cmath.rect(1.0, math.tau / count) == pytest.approx(arrives, abs=1e-12)


@pytest.mark.parametrize("name", CLOSED)
def test_closed_ones_run_the_right_way_round(name: str) -> None:
    outline = CLOSED[name]
    assert outline.closed
    assert outline.hole == (name in ("round hole", "slot"))
    assert not [*filter(lambda finding: finding.applies > 0, outline.findings("x"))]
    assert outline.area().area > 0.0


# Closed forms.


def test_a_sharp_ratchet_tooth_is_the_papers() -> None:
    points = wheel_outline(sawtooth(*RATCHET), RATCHET[0], RATCHET[2])  # clockwise from the root at (r, 0)
    for (x, y, _), point in zip(ratchet_tooth(*RATCHET).vertices, points[2::-1], strict=True):
        assert (x, y) == pytest.approx(point)


def test_a_ratchet_wheel_has_the_area_of_its_triangles_less_its_roundings() -> None:
    """Each rounding takes r^2 (tan(tau/2) - tau/2), a fillet gives it."""
    tip, fillet = 5e-4, 1e-3
    count, tooth = 10, sawtooth(*RATCHET)
    at_tip, at_root = math.pi - tooth.apex_angle, math.pi - tooth.apex_angle - tooth.pitch
    sharp, round_one = (
        wheel(count, ratchet_tooth(*RATCHET, tip_radius=t, root_fillet=f)).area().area
        for t, f in ((0.0, 0.0), (tip, fillet))
    )
    triangles = (
        count
        * 0.5
        * 0.1
        * (0.1 * math.sin(tooth.pitch) + tooth.slope_length * tooth.chord / 0.1 * math.sin(tooth.chord_angle))
    )
    assert sharp == pytest.approx(triangles)
    lost = tip**2 * (math.tan(at_tip / 2) - at_tip / 2) - fillet**2 * (math.tan(at_root / 2) - at_root / 2)
    assert round_one == pytest.approx(sharp - count * lost, rel=1e-12)


def test_a_tip_has_the_radius_that_was_asked_for() -> None:
    for tooth, radii in (
        (TEETH["rounded ratchet"][1], (-1e-3, 5e-4, -1e-3)),
        (TEETH["rounded escape"][1], (-2e-4, 1e-4, -2e-4)),
    ):
        assert [e.radius for e in tooth.elements if not e.is_straight] == pytest.approx(radii, rel=1e-9)
        assert turns(tooth) == pytest.approx([0.0] * len(turns(tooth)), abs=1e-9)


@given(st.floats(1e-7, 5e-4), st.floats(1e-7, 1e-3))
def test_roundings_of_no_size_are_the_sharp_tooth(tip: float, fillet: float) -> None:
    """Areas differ by less than the squares of the corners."""
    sharp = wheel(10, ratchet_tooth(*RATCHET)).area().area
    rounded = wheel(10, ratchet_tooth(*RATCHET, tip_radius=tip, root_fillet=fillet)).area().area
    assert abs(rounded - sharp) < 10 * (tip * tip + fillet * fillet) + 1e-15


@given(st.integers(3, 40), st.floats(0.2, 1.2))
def test_ratchets_of_all_sizes_join(count: int, ratio: float) -> None:
    tooth = ratchet_tooth(count, math.pi / 2, 0.1, ratio)
    whole = wheel(count, tooth)
    assert whole.area().area > 0.5 * count * 0.01 * math.sin(math.tau / count)  # more than the polygon of its roots


def off_involute(count: int, pressure_angle: float) -> float:
    """By how much the flank is off the involute, seen from the arc's centre, in modules."""
    tooth = involute_tooth(count, 1.0, pressure_angle=pressure_angle)
    flank = next(element for element in tooth.elements if not element.is_straight)
    base, tip = count / 2 * math.cos(pressure_angle), count / 2 + 1.0
    at_base = math.pi / (2 * count) + math.tan(pressure_angle) - pressure_angle
    start, centre = math.hypot(*flank.start), complex(*flank.centre)
    worst = 0.0
    for k in range(201):
        radius = start + (tip - start) * k / 200
        tangent = math.sqrt(max((radius / base) ** 2 - 1.0, 0.0))
        at = cmath.rect(radius, -(at_base - tangent + math.atan(tangent)))
        worst = max(worst, abs(abs(at - centre) - abs(flank.radius)))
    return worst


@pytest.mark.parametrize(("least", "most", "bound"), [(12, 20, 0.02), (20, 60, 0.013), (60, 200, 0.0025)])
def test_a_flank_is_as_near_to_the_involute_as_its_docstring_says(least: int, most: int, bound: float) -> None:
    assert max(off_involute(count, deg(20)) for count in range(least, most)) < bound


def test_a_tooth_is_half_a_pitch_thick_less_its_backlash() -> None:
    """Where both flanks cross the pitch circle, through which both arcs go."""
    tooth = involute_tooth(24, 0.002, backlash=1e-4)
    radius, half = 0.024, (math.pi * 0.002 / 2 - 1e-4) / (2 * 0.024)
    flanks = [e for e in tooth.elements if not e.is_straight]
    for flank, side in ((flanks[0], -1), (flanks[-1], 1)):
        at = cmath.rect(radius, side * half)
        assert abs(at - complex(*flank.centre)) == pytest.approx(abs(flank.radius), rel=1e-12)


def test_tip_and_root_of_a_gear_are_where_modules_say() -> None:
    tooth = involute_tooth(24, 0.002)
    radii = [math.hypot(x, y) for x, y, _ in tooth.vertices]
    assert max(radii) == pytest.approx(0.024 + 0.002)
    assert radii[1] == pytest.approx(0.024 - 1.25 * 0.002)
    tip = tooth.elements[3]
    assert tip.radius == pytest.approx(0.026)
    assert tip.centre == pytest.approx((0.0, 0.0), abs=1e-15)


def test_a_geneva_wheel_lets_its_pin_in_and_stands_around_its_driver() -> None:
    tooth = geneva_sector(*GENEVA, mouth_radius=0.003)
    turned = tooth.moved(angle=math.pi / 4)  # its first slot is along the x axis
    bottom, wall, mouth = turned.elements[:3]
    outer = 0.1 * math.cos(math.pi / 4)
    assert bottom.centre == pytest.approx((outer - 0.045 + 0.0062, 0.0), abs=1e-15)
    assert [wall.start[1], wall.end[1]] == pytest.approx([0.0062, 0.0062])
    assert mouth.radius == pytest.approx(0.003)
    assert mouth.end == pytest.approx((outer, 0.0092))
    lock = tooth.elements[4]
    assert lock.centre == pytest.approx((0.1, 0.0))
    assert lock.radius == pytest.approx(-0.05)
    assert turns(tooth)[:3] == pytest.approx([0.0] * 3, abs=1e-9)


def test_pallets_of_graham_are_sectors_of_a_ring() -> None:
    """Entry and exit, mirror images of each other but for where the impulse face slants."""
    inner, outer = 0.0287, 0.0313
    for name, spans in (("deadbeat entry", (8.0, 10.0)), ("deadbeat exit", (10.0, 8.0))):
        pallet = CLOSED[name]
        arcs = [e for e in pallet.elements if not e.is_straight]
        assert [arc.radius for arc in arcs] == pytest.approx([outer, -inner])
        assert [abs(arc.sweep) for arc in arcs] == pytest.approx([math.radians(span) for span in spans])
        wedge = math.radians(2.0)  # between the impulse face's ends: triangles in place of a sector
        ring = 0.5 * math.radians(8.0) * (outer**2 - inner**2)
        far = inner if name == "deadbeat entry" else outer
        face = 0.5 * inner * outer * math.sin(wedge) - 0.5 * inner**2 * wedge
        more = face if far == inner else 0.5 * outer**2 * wedge - 0.5 * inner * outer * math.sin(wedge)
        assert pallet.area().area == pytest.approx(ring + more, rel=1e-10)


def test_holes_and_hooks_have_their_areas() -> None:
    assert round_hole(0.01).area().area == pytest.approx(math.pi * 1e-4)
    assert slot_hole(0.1, 0.02).area().area == pytest.approx(0.1 * 0.02 + math.pi * 1e-4)
    assert slot_hole(0.1, 0.02, (0.2, 0.1), 0.5).area().area == pytest.approx(0.1 * 0.02 + math.pi * 1e-4)
    assert hook(*HOOK).area().area == pytest.approx(0.1 * 0.01 + 0.012 * 0.02)
    lean = hook(*HOOK, undercut=deg(10)).area().area - hook(*HOOK).area().area
    assert lean == pytest.approx(0.5 * 0.012**2 * math.tan(deg(10)))
    rounded = hook(*HOOK, tip_radius=1e-3, throat_fillet=2e-3).area().area
    assert rounded == pytest.approx(hook(*HOOK).area().area + (1 - math.pi / 4) * (2e-3**2 - 2 * 1e-3**2))
    assert recoil_pallet((0, 0), (3e-3, 4e-3), 1e-3).area().area == pytest.approx(5e-6)
    leaning = recoil_pallet((0, 0), (0.01, 0), 0.002, relief_angle=deg(45))
    assert leaning.area().area == pytest.approx(2e-5)
    assert leaning.points[2] == pytest.approx((0.008, 0.002))


def test_an_escape_tooth_leans_as_its_faces_say() -> None:
    tooth = escape_tooth(*ESCAPE)
    tip = tooth.vertices[2]
    assert tip[:2] == (0.03, 0.0)
    for foot, angle in ((tooth.vertices[1], 22.0), (tooth.vertices[3], 8.0)):
        assert math.hypot(*foot[:2]) == pytest.approx(0.025)
        assert math.degrees(math.atan2(-foot[1], 0.03 - foot[0])) == pytest.approx(angle)


def test_dimensions_may_be_parameters() -> None:
    """As symbolic numbers pass, all are what plain numbers give."""

    def mechanism(v: SimpleNamespace) -> Mechanism:
        body = rigid_body("wheel", mass=1.0, inertia=1.0)
        of_wheel = (
            ratchet_tooth(10, v.slope, 0.1, 1.115, tip_radius=v.tip, root_fillet=v.fillet),
            involute_tooth(24, v.tip * 4.0, root_fillet=0.25 * v.fillet, pressure_angle=v.pressure),
            geneva_sector(4, 0.1, 0.012, 0.045, 0.05, mouth_radius=v.fillet),
            escape_tooth(30, 0.03, 0.025, v.pressure - deg(12), deg(22), tip_radius=0.1 * v.tip, root_fillet=1e-4),
            deadbeat_pallet(0.02 + v.tip, 0.03, deg(226), deg(224) + v.tip, deg(216)),
            recoil_pallet((0.0, v.tip), (0.01, 0.0), 0.01, corner_radius=v.tip),
            hook(*HOOK, tip_radius=v.tip, throat_fillet=v.fillet, undercut=v.pressure - deg(20)),
            round_hole(v.tip),
            slot_hole(v.tip, v.fillet),
            pin_tooth(12, 0.1, v.tip),
        )
        contacts = tuple(
            OutlineContact(f"c{k}", "wheel", GROUND, outline_i=shape, outline_j=Outline.circle(0.01, (k + 9.0, 9.0)))
            for k, shape in enumerate(of_wheel)
        )
        return Mechanism((body,), (Revolute("pin", GROUND, body.at(0.0, 0.0)),), contacts=contacts)

    model = Model(
        "Shapes",
        "All ready outlines",
        (
            Parameter("slope", deg(90), "Slope angle", "rad", deg(80), deg(100)),
            Parameter("tip", 5e-4, "Rounding of tips", "m", 1e-5, 1e-3),
            Parameter("fillet", 1e-3, "Fillets", "m", 1e-5, 2e-3),
            Parameter("pressure", deg(20), "Pressure angle", "rad", deg(15), deg(25)),
        ),
        mechanism,
    )
    values = model.values(slope=deg(95), tip=6e-4, fillet=8e-4, pressure=deg(21))
    traced = trace(model).evaluate(values).columns
    plain = compile_mechanism(model.build(values))
    assert len(plain.columns["outline_data"]) == 20
    for name in ("feature_data", "outline_data"):
        assert traced[name] == pytest.approx(plain.columns[name], rel=1e-9, abs=1e-12)


def test_a_wheel_of_ready_teeth_is_accepted() -> None:
    body, other = rigid_body("wheel", mass=1.0, inertia=1.0), rigid_body("pin", (1.0, 0.0), mass=1.0, inertia=1.0)
    contacts = [
        OutlineContact(f"c{k}", other, body, outline_i=Outline.circle(0.01), outline_j=tooth, copies=CircularCopies(n))
        for k, (n, tooth) in enumerate(TEETH.values())
    ]
    Model("X", "x", (), lambda _: Mechanism((body, other), contacts=tuple(contacts))).build(SimpleNamespace())


# What is refused.


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ratchet_tooth(2, 1.5, 0.1, 1.0), "tooth_count = 2, but it must be a whole number of at least 3"),
        (lambda: ratchet_tooth(10, 1.2, 0.1, 1.0), r"slope_angle = 68.7\d* deg, but it must lie between 72 and 180"),
        (lambda: ratchet_tooth(10, 1.5, -0.1, 1.0), "inner_radius = -0.1 m, but it must be positive"),
        (lambda: ratchet_tooth(10, 1.5, 0.1, 0.0), "slope_ratio = 0, but it must be positive"),
        (lambda: ratchet_tooth(*RATCHET, tip_radius=-1.0), "tip_radius = -1 m, but it must be not negative"),
        (lambda: ratchet_tooth(*RATCHET, tip_radius="20 mm"), r"tip_radius need 0\.\d+ m of an edge, but it is 0\.0"),
        (lambda: ratchet_tooth(*RATCHET, root_fillet="5 s"), "root_fillet wants m"),
        (lambda: involute_tooth(4, 0.001), "tooth_count = 4"),
        (lambda: involute_tooth(20, 0.0), "module = 0 m"),
        (lambda: involute_tooth(20, 0.001, pressure_angle=deg(50)), "pressure_angle = 50 deg.* between 5 and 40"),
        (lambda: involute_tooth(20, 0.001, addendum=-1.0), "addendum = -1 modules"),
        (lambda: involute_tooth(20, 0.001, addendum=3.0), "addendum = 3 modules makes the tooth pointed"),
        (lambda: involute_tooth(20, 0.001, dedendum=11.0), "dedendum = 11 modules, but it must be less than 10"),
        (lambda: involute_tooth(20, 0.001, root_fillet=0.001), "root_fillet need"),
        (lambda: pin_tooth(1, 0.1, 0.01), "tooth_count = 1"),
        (lambda: pin_tooth(12, 0.1, 0.03), r"pin_radius = 0.03 m, but it must be less than 0.0258819 m"),
        (lambda: geneva_sector(4, 0.1, 0.01, 0.08, 0.05), "slot_depth = 0.08 m, but it must lie between 0.005 m and"),
        (lambda: geneva_sector(4, 0.1, 0.01, 0.04, 0.07), "locking_radius = 0.07 m, but it must be less than 0.0657"),
        (lambda: escape_tooth(30, 0.02, 0.025, 0.1, 0.3), "root_circle_radius = 0.025 m.* less than tip_circle_radius"),
        (lambda: escape_tooth(30, 0.03, 0.025, 0.3, 0.1), "back_angle = 5.7.* deg.* larger than front_angle"),
        (lambda: escape_tooth(30, 0.03, 0.015, 0.1, 0.8), "back_angle = 45.8.* deg passes the centre at 0.0215"),
        (lambda: escape_tooth(90, 0.03, 0.025, 0.1, 0.8), "0.216.* rad wide at its foot, but its pitch is 0.0698"),
        (lambda: deadbeat_pallet(0.03, 0.02, 1.0, 1.1, 0.5), "inner_radius = 0.03 m.* less than outer_radius = 0.02"),
        (lambda: deadbeat_pallet(0.02, 0.03, 1.0, 1.2, 1.1), "back_angle = 63.* deg.* on one side"),
        (lambda: deadbeat_pallet(0.02, 0.03, 1.0, 1.2, math.nan), "back_angle = nan"),
        (lambda: recoil_pallet((0, 0), (0, 0), 0.01), "its face is 0 m long"),
        (lambda: recoil_pallet((0, 0), (0.01, 0), 0.01, corner_radius=0.01), "corner_radius need 0.02 m of an edge"),
        (lambda: recoil_pallet((0, 0), (0.01, 0), 0.01, relief_angle=deg(80)), "relief_angle = 80 deg"),
        (lambda: hook(0.1, 0.01, 0.01, 0.2), "nose_length = 0.2 m, but it must be less than the length of 0.1 m"),
        (lambda: hook(*HOOK, undercut=deg(-60)), "undercut = -60 deg"),
        (lambda: round_hole(0.0), "round_hole: radius = 0 m"),
        (lambda: slot_hole(0.1, math.inf), "slot_hole: width = inf m"),
    ],
)
def test_what_cannot_be_is_refused(make: object, message: str) -> None:
    with pytest.raises(MechanismError, match=message):
        make()  # type: ignore[operator]


def test_the_middle_of_a_fillet_halves_it() -> None:
    tooth = TEETH["rounded ratchet"][1]
    first, last = tooth.elements[0], tooth.elements[-1]
    assert isinstance(first, Element)
    assert first.sweep == pytest.approx(last.sweep)
    assert first.sweep < 0.0
