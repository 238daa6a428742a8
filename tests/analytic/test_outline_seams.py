"""Where copies of an open chain join, the outline goes on as one closed chain does, with or without a corner there."""

import math

import pytest

from mechanism_fmu.model import (
    GROUND,
    Body,
    CircularCopies,
    LinearCopies,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation

OUTPUTS = tuple(Output(what, f"thrown.{what}", "") for what in ("x", "y", "angle"))


def polar(radius: float, angle: float) -> tuple[float, float]:
    return radius * math.cos(angle), radius * math.sin(angle)


def moved(body: Body, until: float, **contact: object) -> list[tuple[float, ...]]:
    """Where the body is at forty times."""
    touch = OutlineContact("touch", body, GROUND, **contact)
    simulation = Simulation(Mechanism((body,), contacts=(touch,), gravity=(0.0, -9.81), outputs=OUTPUTS))
    found = []
    for k in range(40):
        simulation.advance(until * (k + 1) / 40)
        found.append(tuple(simulation.read().values()))
    assert simulation.counters[0] > 0 or "restitution" not in contact
    return found


def ring(count: int, points: list[tuple[float, float]]) -> Outline:
    """The closed chain of points that turn from copy to copy."""
    turned = [(radius, angle + math.tau * k / count) for k in range(count) for radius, angle in points]
    return Outline.polygon([polar(*point) for point in turned])


SIDES = {
    "hexagon, a corner at the seam": (6, [(0.5, 0.1)]),
    "star, seams at its tips": (5, [(0.5, 0.0), (0.3, math.pi / 5)]),
    "star, seams in its hollows": (5, [(0.3, 0.0), (0.5, math.pi / 5)]),
    "hexagon, seams within its sides": (6, [(0.5 * math.cos(math.pi / 6), 0.0), (0.5, math.pi / 6)]),
}


@pytest.mark.parametrize("radius", [0.0, 0.06])
@pytest.mark.parametrize("which", SIDES)
@pytest.mark.parametrize("start", [0.05, 0.1, -0.17])
def test_copies_that_join_are_one_outline(which: str, radius: float, start: float) -> None:
    """A disc, or a triangle, that falls on a ring of copies, slides and hops down, as on the ring as one chain."""
    if not radius and which == "star, seams at its tips":
        pytest.skip("a corner that slides off a corner: rounding decides whether it strikes there, in either form")
    count, points = SIDES[which]
    thrown = rigid_body("thrown", (start, 0.62), mass=1.0, inertia=1e-3, velocity=(0.1, 0.0))
    shape = Outline.circle(radius) if radius else Outline.polygon([(0.0, -0.06), (0.05, 0.04), (-0.05, 0.04)])
    following = points[0][0], points[0][1] + math.tau / count
    side = Outline.chain([polar(*point) for point in (*points, following)])
    as_one = moved(thrown, 0.6, outline_i=shape, outline_j=ring(count, points), restitution=0.3, points=4)
    copied = moved(
        thrown, 0.6, outline_i=shape, outline_j=side, copies=CircularCopies(count), restitution=0.3, points=4
    )
    for one, other in zip(as_one, copied, strict=True):
        assert other == pytest.approx(one, abs=1e-7)


@pytest.mark.parametrize("radius", [0.0, 0.05])
def test_nothing_happens_at_the_seams_of_a_floor(radius: float) -> None:
    thrown = rigid_body("thrown", (0.02, radius), mass=1.0, inertia=0.005, velocity=(0.3, 0.0))
    shape = Outline.circle(radius) if radius else Outline.polygon([(0.0, 0.0), (0.01, 0.03), (-0.01, 0.03)])
    floor = Outline.chain([(0.05, 0.0), (-0.05, 0.0)])
    copies = LinearCopies((0.1, 0.0))
    touch = OutlineContact("touch", thrown, GROUND, outline_i=shape, outline_j=floor, copies=copies)
    outputs = tuple(Output(what, f"thrown.{what}", "") for what in ("x", "y"))
    simulation = Simulation(Mechanism((thrown,), contacts=(touch,), gravity=(0.0, -9.81), outputs=outputs))
    seen = []
    for _ in range(20):
        simulation.advance(simulation.time + 0.1)
        seen += [event.guard for event in simulation.events_in_step()]
        assert simulation.read() == pytest.approx({"x": 0.02 + 0.3 * simulation.time, "y": radius}, abs=1e-12)
    assert seen == ["touch.handover"] * 6
    assert simulation.counters[0] == 0


def test_a_ball_in_a_ring_of_arcs_rolls_as_in_a_hole() -> None:
    """Seams between arcs that go on smoothly: one hollow circle."""
    thrown = rigid_body("thrown", (0.4, 0.0), mass=1.0, inertia=1e-3)
    ball, count = Outline.circle(0.1), 12
    sweep = math.tau / count
    arc = Outline(((*polar(0.5, sweep), -math.tan(sweep / 4)), (*polar(0.5, 0.0), 0.0)), closed=False)
    in_hole = moved(thrown, 1.5, outline_i=ball, outline_j=Outline.circle(0.5, hole=True))
    in_ring = moved(thrown, 1.5, outline_i=ball, outline_j=arc, copies=CircularCopies(count))
    for one, other in zip(in_hole, in_ring, strict=True):
        assert other == pytest.approx(one, abs=1e-7)


def test_a_box_slides_in_a_hole_as_a_pendulum() -> None:
    """On two corners, which cross a seam: it turns about the middle of the hole."""
    half, swing, gravity = 0.3, 1.0, 9.81
    far = math.sqrt(1.0 - half**2) - half
    inertia = (2.0 * half) ** 2 / 6.0
    start = (far * math.sin(swing), -far * math.cos(swing), swing)
    box = Body("thrown", 1.0, inertia, start=start)
    square = Outline.polygon([(half, half), (-half, half), (-half, -half), (half, -half)])
    hole = Outline.circle(1.0, hole=True).moved(angle=-1.2)
    touch = OutlineContact("touch", box, GROUND, outline_i=square, outline_j=hole)
    outputs = (*OUTPUTS, Output("speed", "thrown.speed", ""))
    simulation = Simulation(Mechanism((box,), contacts=(touch,), gravity=(0.0, -gravity), outputs=outputs))
    least = swing
    for k in range(1, 101):
        simulation.advance(0.02 * k)
        seen = simulation.read()
        angle = seen["angle"]
        least = min(least, angle)
        assert seen["x"] == pytest.approx(far * math.sin(angle), abs=1e-8)
        assert seen["y"] == pytest.approx(-far * math.cos(angle), abs=1e-8)
        square_rate = 2.0 * gravity * far * (math.cos(angle) - math.cos(swing)) / (inertia + far**2)
        assert seen["speed"] ** 2 == pytest.approx(square_rate, abs=1e-7)
    assert least < -0.99
    assert simulation.counters[0] == 0


@pytest.mark.parametrize("count", [5, 6])
def test_no_copy_is_two(count: int) -> None:
    """A disc slides over a tooth in the same way wherever that stands, and touches it once when a ball strikes far off.

    The copy opposite to the first one is half a turn away in either sense. Known by two numbers, it was touched twice.
    """
    disc, outputs = Outline.circle(0.1), tuple(Output(what, f"thrown.{what}", "") for what in ("x", "y"))
    tooth = Outline.circle(0.4, (1.0, 0.0))
    found = []
    for k in range(count):
        c, s = math.cos(math.tau * k / count), math.sin(math.tau * k / count)

        def turned(x: float, y: float, c: float = c, s: float = s) -> tuple[float, float]:
            return c * x - s * y, s * x + c * y

        start = turned(1.0 + 0.5 * math.cos(-0.15), 0.5 * math.sin(-0.15))
        velocity = turned(-1.2 * math.sin(-0.15), 1.2 * math.cos(-0.15))
        thrown = rigid_body("thrown", start, mass=1.0, inertia=0.005, velocity=velocity)
        ball = rigid_body("ball", turned(9.0, 0.0), mass=1.0, inertia=0.005, velocity=turned(-1.0, 0.0))
        touch = OutlineContact(
            "touch", thrown, GROUND, outline_i=disc, outline_j=tooth, copies=CircularCopies(count), points=4
        )
        far = OutlineContact("far", ball, GROUND, outline_i=disc, outline_j=Outline.circle(0.1, turned(8.5, 0.0)))
        gravity = turned(-9.81, 0.0)
        mechanism = Mechanism((thrown, ball), contacts=(touch, far), gravity=gravity, outputs=outputs)
        simulation = Simulation(mechanism)
        simulation.advance(0.2)
        (strikes,) = (event for event in simulation.events_in_step() if event.guard == "far.gap")
        assert strikes.new_mode == ("touch", "far")
        simulation.advance(0.6)
        shown = simulation.read()
        found += [c * shown["x"] + s * shown["y"], c * shown["y"] - s * shown["x"]]
    assert found == pytest.approx(found[:2] * count, abs=1e-7)
