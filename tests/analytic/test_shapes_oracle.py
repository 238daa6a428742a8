"""Outlines against an oracle: cases computed elsewhere, in two ways each, in tests/data/shapes.json.

The variable SHAPES_ORACLE names another file with other numbers; kinds that it lacks, and kinds without a test here,
are skipped by name.
"""

import json
import math
import re
from dataclasses import replace
from typing import Any, NamedTuple

import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    Body,
    CircularCopies,
    Damper,
    LinearCopies,
    Mechanism,
    Outline,
    OutlineContact,
    PointForce,
    RackAndPinion,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    Translational,
    geneva_sector,
    ratchet_tooth,
)
from mechanism_fmu.moving import Event
from mechanism_fmu.simulation import Simulation
from tests.analytic.linkages_with_play import (
    NAMES_OF_FOUR_BAR,
    G,
    four_bar_with_play,
    of_body,
    slider_crank_in_guide,
    slider_crank_with_play,
)
from tests.exchanged_oracle import kinds_with_tests, of_kind as skipped_without, oracle_path
from tests.outlines_apart import Pose, nearest

OTHER_FILE = "SHAPES_ORACLE"
CASES: list[dict[str, Any]] = json.loads(oracle_path(OTHER_FILE, "shapes.json").read_text(encoding="utf-8"))["cases"]
#: Kinds with a test below: those that it has asked for.
KINDS: set[str] = set()


def of_kind(kind: str) -> list[Any]:
    KINDS.add(kind)
    cases = [pytest.param(case, id=case["case"]) for case in CASES if case["kind"] == kind]
    return skipped_without(OTHER_FILE, kind, cases)


#: As an oracle counts impacts, up to which its digits are held.
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")


def held_impacts(case: dict[str, Any], results: list[Any]) -> list[Any]:
    """The impacts whose digits a case holds: those until a time, until "the fourth impact", or all."""
    until = case.get("until")
    ordinal = re.fullmatch(r"the (\w+) impact", until) if isinstance(until, str) else None
    if ordinal:
        return results[: 1 + _ORDINALS.index(ordinal[1])]
    return [one for one in results if float(one["t"]) <= float(until or math.inf)]


def held_until(case: dict[str, Any], impacts: list[Any]) -> float:
    """The time until which a case holds its digits: given, or of the last of these impacts, if it counts them."""
    until = case.get("until")
    counts = isinstance(until, str) and until.startswith("the ")
    return float(impacts[-1]["t"]) if counts else float(until or math.inf)


@pytest.mark.parametrize("case", of_kind("gap_pairs"))
def test_gap_pairs(case: dict[str, Any]) -> None:
    """The distance that tests measure with is right itself: so is the geometry of elements that it takes."""
    for result in case["results"]:
        a, b = (Outline(tuple(map(tuple, result[f"outline_{which}"]))) for which in "ab")
        found = nearest(a, Pose(*result["pose_a"]), b, Pose(*result["pose_b"]))
        assert found.distance == pytest.approx(result["distance"], abs=case["tolerance"])
        for point, which, element, outline in zip(found.points, "ab", found.elements, (a, b), strict=True):
            assert abs(point - complex(*result[f"point_{which}"])) < 1e-9
            count = len(outline.elements)
            assert (element - result[f"element_{which}"]) % count in (0, 1, count - 1)


# Motions. An impact is told by its time and closing speed, and a state by what outputs show there.


class Struck(NamedTuple):
    """An impact, and the outputs right behind it."""

    time: float
    contact: str
    copy: int
    closing: float
    shown: dict[str, float]


class Moved(NamedTuple):
    """A motion: its impacts, and what else happened."""

    simulation: Simulation
    impacts: list[Struck]
    events: list[Event]


def moved(mechanism: Mechanism, until: float, impacts: int = 1_000_000) -> Moved:
    """A motion up to a time, or so many impacts."""
    simulation = Simulation(replace(mechanism, settings=Settings(relative_tolerance=1e-12)))
    found: list[Struck] = []
    events: list[Event] = []
    while len(found) < impacts and simulation.time < until:
        simulation.begin_step()
        simulation.go_on(until, codes.STOP_AT_IMPACT)
        shown = simulation.read()
        records = simulation.field("impacts")
        for k, one in enumerate(simulation.impacts_in_step()):
            copy = int(records[k, codes.RECORD_TOOTH])
            found.append(Struck(one.time, one.contact, copy, one.closing_speed, shown))
        events += simulation.events_in_step()
    return Moved(simulation, found, events)


def states(mechanism: Mechanism, times: list[float]) -> list[dict[str, float]]:
    """What outputs show at times."""
    simulation = Simulation(replace(mechanism, settings=Settings(relative_tolerance=1e-12)))
    found = []
    for time in times:
        simulation.advance(time)
        found.append(simulation.read())
    return found


def agree(found: list[float], asked: list[float], case: dict[str, Any]) -> None:
    """Within the tolerance of the case, relative to the largest magnitude of the quantity in it.

    Of what is zero but for rounding, as the angle of a slider between its guides, to 1e-3 times that tolerance.
    """
    assert len(found) == len(asked)
    largest = max(map(abs, asked))
    assert found == pytest.approx(asked, rel=0.0, abs=case["tolerance"] * max(largest, 1e-3))


def agree_impacts(of: Moved, results: list[Any], case: dict[str, Any], **names: str) -> None:
    """Times, closing speeds and named quantities of the impacts."""
    impacts = of.impacts[: len(results)]
    agree([one.time for one in impacts], [float(r["t"]) for r in results], case)
    agree([one.closing for one in impacts], [-float(r["closing"]) for r in results], case)
    for name, output in names.items():
        agree([one.shown[output] for one in impacts], [float(r[name]) for r in results], case)


def agree_rates(of: Moved, results: list[Any], names: tuple[str, ...], case: dict[str, Any]) -> None:
    """Coordinates at impacts and rates behind them, in the order of the case."""
    for k, name in enumerate(names):
        impacts = of.impacts[: len(results)]
        agree([one.shown[name] for one in impacts], [float(r["q"][k]) for r in results], case)
        agree([one.shown[f"{name}_rate"] for one in impacts], [float(r["rates_after"][k]) for r in results], case)


def agree_states(found: list[dict[str, float]], results: list[Any], names: tuple[str, ...], case: Any) -> None:
    for k, name in enumerate(names):
        agree([shown[name] for shown in found], [float(r["q"][k]) for r in results], case)
        agree([shown[f"{name}_rate"] for shown in found], [float(r["rates"][k]) for r in results], case)


def polar(radius: float, degrees: float) -> tuple[float, float]:
    return radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))


@pytest.mark.parametrize("case", of_kind("bouncing_square"))
def test_bouncing_square(case: dict[str, Any]) -> None:
    half, mass = 0.05, 1.5
    square = Body("square", mass, mass * (2 * half) ** 2 / 6, start=(0.0, 0.3, 0.3), start_rate=(0.0, 0.0, 1.0))
    sides = Outline.polygon([(half, half), (-half, half), (-half, -half), (half, -half)])
    ground = Outline.chain([(10.0, 0.0), (-10.0, 0.0)])
    contact = OutlineContact("floor", square, GROUND, outline_i=sides, outline_j=ground, restitution=0.8)
    shown = of_body("square.y", "square.angle")
    results = held_impacts(case, case["results"])
    of = moved(Mechanism((square,), contacts=(contact,), gravity=G, outputs=shown), 3.0, len(results))
    agree_impacts(of, results, case, y="square.y", angle="square.angle", y_rate="square.y_rate")


@pytest.mark.parametrize("case", of_kind("disc_over_edge"))
def test_disc_over_edge(case: dict[str, Any]) -> None:
    result = {name: float(value) for name, value in case["results"].items()}
    radius = 0.1
    disc = Body("disc", 1.0, 1.0, start=(-0.2, radius, 0.0), start_rate=(case["data"]["v"], 0.0, 0.0))
    table = Outline.chain([(0.0, -1.0), (0.0, 0.0), (-1.0, 0.0)])
    contact = OutlineContact("table", disc, GROUND, outline_i=Outline.circle(radius), outline_j=table)
    shown = of_body("disc.x", "disc.y")
    mechanism = Mechanism((disc,), contacts=(contact,), gravity=G, outputs=shown)
    of = moved(mechanism, result["t_leaves"] + 0.05)
    assert not of.impacts
    events = {event.guard.partition(".")[2]: event.time for event in of.events}
    assert [*events] == ["handover", "force"]
    agree([events["handover"], events["force"]], [result["t_corner"], result["t_leaves"]], case)
    (at,) = states(mechanism, [result["t_leaves"]])
    agree([at["disc.x"], at["disc.y"]], [result["x"], result["y"]], case)
    agree([at["disc.x_rate"], at["disc.y_rate"]], [result["vx"], result["vy"]], case)


@pytest.mark.parametrize("case", of_kind("ball_in_bowl"))
def test_ball_in_bowl(case: dict[str, Any]) -> None:
    period, amplitude = float(case["results"]["period"]), case["data"]["amplitude"]
    disc = Body("disc", 1.0, 1.0, start=(math.sin(amplitude), -math.cos(amplitude), 0.0))
    bowl = Outline.circle(1.1, hole=True)
    contact = OutlineContact("bowl", disc, GROUND, outline_i=Outline.circle(0.1), outline_j=bowl)
    mechanism = Mechanism((disc,), contacts=(contact,), gravity=G, outputs=of_body("disc.x", "disc.y"))
    found = states(mechanism, [period / 4, period / 2, 5 * period / 4, 2 * period])
    swing = math.sin(amplitude)
    assert [one["disc.x"] for one in found] == pytest.approx([0, -swing, 0, swing], abs=10 * case["tolerance"])


@pytest.mark.parametrize("case", of_kind("ball_in_ring"))
def test_ball_in_ring(case: dict[str, Any]) -> None:
    data = case["data"]
    disc = Body("disc", 1.0, 1.0, start=(*data["start"], 0.0), start_rate=(*data["rates"], 0.0))
    ring = Outline.circle(1.05, hole=True)
    contact = OutlineContact(
        "ring", disc, GROUND, outline_i=Outline.circle(0.05), outline_j=ring, restitution=data["e"]
    )
    mechanism = Mechanism((disc,), contacts=(contact,), gravity=G, outputs=of_body("disc.x", "disc.y"))
    names = {name: f"disc.{name}" for name in ("x", "y", "x_rate", "y_rate")}
    results = held_impacts(case, case["results"])
    agree_impacts(moved(mechanism, 60.0, len(results)), results, case, **names)


@pytest.mark.parametrize("case", of_kind("galton"))
def test_galton(case: dict[str, Any]) -> None:
    data, step = case["data"], 0.02
    ball = Body("ball", 1.0, 1.0, start=(data["x"], 0.05, 0.0))
    rows = [
        OutlineContact(
            f"row_{i}",
            ball,
            GROUND,
            outline_i=Outline.circle(0.004),
            outline_j=Outline.circle(0.002, (0.5 * step if i % 2 else 0.0, -0.02 * i)),
            copies=LinearCopies((step, 0.0)),
            restitution=data["e"],
        )
        for i in range(6)
    ]
    shown = of_body("ball.x", "ball.y")
    results = held_impacts(case, case["results"])
    of = moved(Mechanism((ball,), contacts=tuple(rows), gravity=G, outputs=shown), 2.0, len(results))
    names = {name: f"ball.{name}" for name in ("x", "y", "x_rate", "y_rate")}
    agree_impacts(of, results, case, **names)
    assert [[int(one.contact[4]), one.copy] for one in of.impacts] == [r["peg"] for r in results]


@pytest.mark.parametrize("case", of_kind("slider_crank_guide"))
def test_slider_crank_guide(case: dict[str, Any]) -> None:
    mechanism = slider_crank_in_guide(case["data"]["e"], case["data"]["w3"])
    results = held_impacts(case, case["results"]["impacts"])
    until = held_until(case, results)
    of = moved(mechanism, until, len(results))
    agree_impacts(of, results, case)
    names = ("crank.angle", "rod.angle", "slider.angle")
    agree_rates(of, results, names, case)
    shown = [one for one in case["results"]["states"] if float(one["t"]) <= until]
    agree_states(states(mechanism, [float(one["t"]) for one in shown]), shown, names, case)


@pytest.mark.parametrize("case", of_kind("slider_crank_pin_in_hole"))
def test_slider_crank_pin_in_hole(case: dict[str, Any]) -> None:
    mechanism = slider_crank_with_play(case["data"]["e"])
    names = ("crank.angle", "rod.angle", "slider.x")
    held = held_impacts(case, case["results"]["impacts"])
    shown = [one for one in case["results"]["states"] if float(one["t"]) <= held_until(case, held)]
    last = max(float(one["t"]) for one in shown)
    results = [one for one in held if float(one["t"]) <= last]
    of = moved(mechanism, last)
    assert len(of.impacts) == len(results)
    agree_impacts(of, results, case)
    agree_rates(of, results, names, case)
    agree_states(states(mechanism, [float(one["t"]) for one in shown]), shown, names, case)


@pytest.mark.parametrize("case", of_kind("four_bar_three_clearances"))
def test_four_bar_three_clearances(case: dict[str, Any]) -> None:
    l0, mechanism, names = 3.0, four_bar_with_play(case["data"]["e"]), NAMES_OF_FOUR_BAR
    results = held_impacts(case, case["results"]["impacts"])
    until = held_until(case, results)
    shown = [one for one in case["results"]["states"] if float(one["t"]) <= until]

    def with_offset(results: list[Any]) -> list[Any]:
        """The case counts x of the rocker from its hinge."""
        return [one | {"q": [*map(float, one["q"][:5]), float(one["q"][5]) + l0, one["q"][6]]} for one in results]

    of = moved(mechanism, until + 0.001, len(results))
    assert [one.contact for one in of.impacts] == [one["contact"] for one in results]
    agree_impacts(of, results, case)
    agree_rates(of, with_offset(results), names, case)
    agree_states(states(mechanism, [float(one["t"]) for one in shown]), with_offset(shown), names, case)


@pytest.mark.parametrize("is_ready", [False, True])
@pytest.mark.parametrize("case", of_kind("geneva_entry"))
def test_geneva_entry(case: dict[str, Any], is_ready: bool) -> None:
    """With both walls of a slot as chains of their own, and with the arms of a ready wheel, which have the same."""
    arm, off = 0.1 * math.sin(math.radians(45)), case["data"]["off"]
    driver = Body("driver", 1.0, 2e-4, start=(0.0, 0.0, math.radians(60)), start_rate=(0.0, 0.0, -10.0))
    wheel = Body("wheel", 1.0, 1e-4, start=(0.1, 0.0, math.radians(135) + off))
    mouth, half, inner, quarter = arm - 0.003, 0.0062, 0.03, math.tan(math.pi / 8)
    sides = {
        "lower": ((arm, -half - 0.003, quarter), (mouth, -half, 0.0), (inner, -half, 0.0)),
        "upper": ((inner, half, 0.0), (mouth, half, quarter), (arm, half + 0.003, 0.0)),
    }
    walls = {name: Outline(side, closed=False) for name, side in sides.items()}
    if is_ready:
        sector = geneva_sector(4, 0.1, 2 * half, arm - inner + half, 0.04, mouth_radius=0.003)
        walls = {"arm": sector.moved(angle=math.radians(45))}
    pin = Outline.circle(0.006, (arm, 0.0))
    contacts = tuple(
        OutlineContact(
            name,
            driver,
            wheel,
            outline_i=pin,
            outline_j=wall,
            copies=CircularCopies(4),
            restitution=case["data"]["e"],
        )
        for name, wall in walls.items()
    )
    names = ("driver.angle", "wheel.angle")
    hinges = (Revolute("a", driver.at(0, 0), GROUND), Revolute("b", wheel.at(0, 0), GROUND.at(0.1, 0.0)))
    mechanism = Mechanism((driver, wheel), hinges, contacts=contacts, outputs=of_body(*names))
    results, shown = case["results"]["impacts"], case["results"]["states"]
    of = moved(mechanism, float(shown[-1]["t"]))
    struck = [one.contact.partition("_")[0] for one in of.impacts]
    assert struck == ["arm" if is_ready else one["contact"].split()[1] for one in results]
    agree_impacts(of, results, case)
    agree_rates(of, results, names, case)
    agree_states(states(mechanism, [float(one["t"]) for one in shown]), shown, names, case)


@pytest.mark.parametrize("is_ready", [False, True])
@pytest.mark.parametrize("case", of_kind("ratchet_round_pawl"))
def test_ratchet_round_pawl(case: dict[str, Any], is_ready: bool) -> None:
    wheel = Body("wheel", 1.0, 32.7948e-3, start=(0.0, 0.0, math.radians(92)), start_rate=(0.0, 0.0, 2.0))
    pawl = Body("pawl", 1.0, 0.0853e-3 + 0.0976 * 0.05**2, start=(0.09, 0.15, math.radians(195)))
    root, following = polar(0.1, 0.0), polar(0.1, -36.0)
    apex = root[0], -1.115 * 0.2 * math.sin(math.radians(18))
    tooth = ratchet_tooth(10, math.radians(90), 0.1, 1.115) if is_ready else Outline.chain([following, apex, root])
    contact = OutlineContact(
        "tooth",
        pawl,
        wheel,
        outline_i=Outline.circle(0.5e-3, (0.1, 0.0)),
        outline_j=tooth,
        copies=CircularCopies(10),
        restitution=case["data"]["e"],
    )
    names = ("wheel.angle", "pawl.angle")
    hinges = (Revolute("a", wheel.at(0, 0), GROUND), Revolute("b", pawl.at(0, 0), GROUND.at(0.09, 0.15)))
    spring = Torque("spring", pawl, torque=0.05)
    mechanism = Mechanism((wheel, pawl), hinges, (spring,), (contact,), outputs=of_body(*names))
    results, shown = case["results"]["impacts"], case["results"]["states"]
    of = moved(mechanism, float(shown[-1]["t"]))
    assert [-one.copy % 10 for one in of.impacts] == [int(one["contact"].split()[1]) for one in results]
    agree_impacts(of, results, case)
    agree_rates(of, results, names, case)
    agree_states(states(mechanism, [float(one["t"]) for one in shown]), shown, names, case)
    changes = case["results"]["mode_changes"]
    found = [event for event in of.events if event.guard.endswith(("handover", "force"))]
    # what passes on to the apex and leaves it at the same instant is one event here
    asked = [one for k, one in enumerate(changes) if not (k and changes[k - 1]["t"] == one["t"])]
    agree([event.time for event in found], [float(one["t"]) for one in asked], case)


def ticks(mechanism: Mechanism, case: dict[str, Any], wheel: str, verge: str, count: int) -> Moved:
    """The first ticks of an escapement: when, on which tooth of which pallet, how fast, and where both stand."""
    results = case["results"]["first_ticks"]
    of = moved(mechanism, 20.0, len(results))
    agree_impacts(of, results, case, wheel_angle=wheel, verge_angle=verge)
    for one, result in zip(of.impacts, results, strict=True):
        pallet, _, tooth = result["contact"].partition("/")
        assert one.contact.partition("_")[0] == pallet
        assert (one.copy - int(tooth)) % count == 0
    return of


@pytest.mark.parametrize("case", of_kind("verge"))
def test_verge(case: dict[str, Any]) -> None:
    radius = 0.02
    pitch = 2 * math.pi * radius / 15
    wheel, verge = Body("wheel", 1.0, 1e-5), Body("verge", 1.0, 2e-5)
    # of the wheel, one half of the inertia is in its upper and lower teeth, which move to either side
    names = ("upper", "lower")
    racks = [Body(f"{name}_teeth", 0.5e-5 / radius**2, 1.0, start=(0.0, -0.008, 0.0)) for name in names]
    tooth = Outline.circle(0.2e-3)
    pallets = {"upper": [polar(0.002, -60), polar(0.010, -60)], "lower": [polar(0.010, -120), polar(0.002, -120)]}
    contacts = tuple(
        OutlineContact(
            name,
            verge,
            rack,
            outline_i=Outline.chain(pallets[name]),
            outline_j=tooth.moved(0.5 * pitch if name == "lower" else 0.0),
            copies=LinearCopies((pitch, 0.0)),
        )
        for name, rack in zip(pallets, racks, strict=True)
    )
    joints = (
        Revolute("a", wheel.at(0, 0), GROUND),
        Revolute("b", verge.at(0, 0), GROUND),
        *(
            Translational(f"guide_{rack.name}", rack.line((0, 0), (1.0, 0.0)), GROUND.line((0, -0.008), (1.0, 0.0)))
            for rack in racks
        ),
        *(
            RackAndPinion(
                f"mesh_{rack.name}",
                rack.line((0.0, 0.008 - side * radius), (side, 0.0)),
                wheel.at(0, 0),
                rack.at(0.0, 0.008 - side * radius),
                radius_j=radius,
                angle_j=-side * math.pi / 2,
            )
            for rack, side in zip(racks, (1.0, -1.0), strict=True)
        ),
    )
    mechanism = Mechanism(
        (wheel, verge, *racks),
        joints,
        (Torque("drive", wheel, torque=case["data"]["torque"]),),
        contacts,
        outputs=of_body("wheel.angle", "verge.angle"),
    )
    ticks(mechanism, case, "wheel.angle", "verge.angle", 1_000_000_007)


def ring_sector(outer: tuple[float, float], inner: tuple[float, float], middle: float, half: float) -> Outline:
    """Between two circles about the origin: from and to which angle on the outer and on the inner one [deg]."""
    (u0, u1), (v0, v1) = outer, inner
    out, back = math.tan(math.radians(u1 - u0) / 4), -math.tan(math.radians(v1 - v0) / 4)
    places = polar(middle + half, u0), polar(middle + half, u1), polar(middle - half, v1), polar(middle - half, v0)
    return Outline(tuple((*at, bulge) for at, bulge in zip(places, (out, 0.0, back, 0.0), strict=True)))


@pytest.mark.parametrize("case", of_kind("graham_dead_beat"))
def test_graham_dead_beat(case: dict[str, Any]) -> None:
    radius = 0.03
    start = math.radians(135) + 1.7e-3 / radius
    wheel = Body("wheel", 1.0, 2e-5, start=(0.0, 0.0, start))
    hinge = (0.0, radius / math.cos(math.radians(45)))
    anchor = Body("anchor", 1.0, 0.988, start=(*hinge, math.radians(3)))
    pallets = {
        "entry": ring_sector((216.5, 224.5), (216.5, 226.5), radius, 1.3e-3),
        "exit": ring_sector((313.5, 323.5), (315.5, 323.5), radius, 1.3e-3),
    }
    contacts = tuple(
        OutlineContact(
            name,
            anchor,
            wheel,
            outline_i=pallet,
            outline_j=Outline.circle(0.2e-3, (radius, 0.0)),
            copies=CircularCopies(30),
        )
        for name, pallet in pallets.items()
    )
    mechanism = Mechanism(
        (wheel, anchor),
        (Revolute("a", wheel.at(0, 0), GROUND), Revolute("b", anchor.at(0, 0), GROUND.at(*hinge))),
        (
            Torque("drive", wheel, torque=-0.012),
            Damper("air", anchor, damping=0.1),
            PointForce("weight", anchor.at(0.0, -1.0), force=(0.0, -9.75)),
        ),
        contacts,
        outputs=of_body("wheel.angle", "anchor.angle"),
    )
    ticks(mechanism, case, "wheel.angle", "anchor.angle", 30)


@pytest.mark.parametrize("case", of_kind("pin_pallet"))
def test_pin_pallet(case: dict[str, Any]) -> None:
    wheel = Body("wheel", 1.0, 2e-6, start=(0.0, 0.0, math.radians(132 + 4.6 + 1.5)))
    hinge = (0.0, 0.03 / math.cos(math.radians(42)))
    inertia = 2e-4
    lever = Body("lever", 1.0, inertia, start=(*hinge, math.radians(6)))
    tooth = Outline.chain([polar(0.025, -4.6), polar(0.0290, -4.6), polar(0.0304, 4.6), polar(0.025, 2.6)])
    contacts = []
    for name, direction in (("entry", 132), ("exit", 48)):
        x, y = polar(0.0298, direction)
        contacts.append(
            OutlineContact(
                name,
                lever,
                wheel,
                outline_i=Outline.circle(0.4e-3, (x, y - hinge[1])),
                outline_j=tooth,
                copies=CircularCopies(15),
            )
        )
    mechanism = Mechanism(
        (wheel, lever),
        (Revolute("a", wheel.at(0, 0), GROUND), Revolute("b", lever.at(0, 0), GROUND.at(*hinge))),
        (
            Torque("drive", wheel, torque=-case["data"]["torque"]),
            TorsionSpring("balance_spring", lever, stiffness=inertia * (5 * math.pi) ** 2, free_angle=0.0),
            Damper("air", lever, damping=inertia * 5 * math.pi / 10),
        ),
        tuple(contacts),
        outputs=of_body("wheel.angle", "lever.angle"),
    )
    ticks(mechanism, case, "wheel.angle", "lever.angle", 15)


@pytest.mark.parametrize("kind", kinds_with_tests(OTHER_FILE, (case["kind"] for case in CASES), KINDS))
def test_kind_is_known(kind: str) -> None:
    assert kind in KINDS
