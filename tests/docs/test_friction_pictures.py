"""The pictures of docs/explanation/friction.md show what the engine does: events between modes, impacts, regions."""

import json
import math
from itertools import product
from pathlib import Path

import pytest

from docs.drawings.friction_impact_drawing import (
    COLOURS,
    G_NN,
    G_NT,
    MU,
    SPEED,
    E,
    blow,
    compressed,
    sticking,
    turning_point,
)
from docs.drawings.friction_modes_drawing import EVENTS, MODES
from docs.drawings.painleve_drawing import (
    GRAVITY,
    STARTS,
    critical_angles,
    critical_friction,
    critical_rate,
    motion,
    rod,
    solutions,
)
from mechanism_fmu.model import GROUND, Input, Mechanism, Output, PointForce, PointLineContact, rigid_body
from mechanism_fmu.simulation import Simulation, friction_solutions

CASES = json.loads((Path(__file__).parents[1] / "data" / "friction.json").read_text(encoding="utf-8"))["cases"]
SIDE = {"slips forwards": 1.0, "slips backwards": -1.0, "sticks": 0.0}


def mode_of(seen: dict[str, float]) -> str:
    if not seen["closed"]:
        return "apart"
    if seen["sticks"]:
        return "sticks"
    return "slips forwards" if seen["slip"] > 0.0 else "slips backwards"


def leads(before: str, after: str) -> list[tuple[str, str, str]]:
    """A block of 1 kg on a floor with mu = 0.3, 0.4 to stick: mode, event, mode behind it, of all events in 0.3 s.

    It falls, is lifted, is pulled along, or slows down; what reverses is pulled back by more than it may hold.
    """
    height = 0.001 if before == "apart" else 0.0
    speed = SIDE[after] if before == "apart" else SIDE[before]
    pull = {("sticks", "slips forwards"): 40.0, ("sticks", "slips backwards"): -40.0}.get((before, after), 0.0)
    steady, lift = 0.0, 0.0
    if after == "apart":
        lift = 60.0
    elif before.startswith("slips"):
        speed, steady = 0.2 * SIDE[before], -6.0 * SIDE[before] if after.startswith("slips") else 0.0
    block = rigid_body("block", (0.0, height), mass=1.0, inertia=1.0, velocity=(speed, 0.0))
    floor = GROUND.line((0, 0), (1, 0))
    contact = PointLineContact("floor", block.at(0, 0), floor, closed=height == 0.0, friction=0.3, friction_static=0.4)
    sources = {"closed": "floor.closed", "sticks": "floor.sticks", "slip": "floor.slip_speed"}
    simulation = Simulation(
        Mechanism(
            (block,),
            contacts=(contact,),
            forces=(PointForce("hand", block.at(0, 0)),),
            inputs=(Input("pull", "hand.x", steady, "", "N"), Input("lift", "hand.y", 0.0, "", "N")),
            outputs=tuple(Output(name, source, "") for name, source in sources.items()),
            gravity=(0.0, -9.81),
        )
    )
    found = []
    mode = mode_of(simulation.read())
    for k in range(1, 301):
        simulation.set_slope("pull", pull)
        simulation.set_slope("lift", lift)
        simulation.advance(0.001 * k)
        events = [event.guard for event in simulation.events_in_step() if event.guard != "input"]
        now = mode_of(simulation.read())
        found += [(mode, event, now) for event in events]
        mode = now
    return found


@pytest.mark.parametrize(("before", "after"), EVENTS, ids=lambda mode: mode.replace(" ", "_"))
def test_an_arrow_between_modes_is_an_event_of_the_engine(before: str, after: str) -> None:
    name, _ = EVENTS[before, after]
    assert leads(before, after)[0] == (before, f"floor.{name}", after)


def test_there_is_an_arrow_between_any_two_modes() -> None:
    assert set(EVENTS) == {pair for pair in product(MODES, MODES) if pair[0] != pair[1]}


def test_the_blow_is_one_of_the_oracle() -> None:
    """The same blow in exact fractions (Stronge's: closed form)."""
    (case,) = (case for case in CASES if case["id"] == "5")
    (row,) = (row for row in case["results"]["impacts"] if (row["v"], row["mu"], row["e"]) == ([*SPEED, 0.0], MU, E))
    for law in COLOURS:
        assert blow(law).impulse == pytest.approx((row[law]["P_N"], row[law]["P_T"]), rel=1e-12)
        assert blow(law).energy == pytest.approx(row[law]["T_after"], rel=1e-12)


def test_the_laws_end_where_lines_and_path_say() -> None:
    newton, poisson, stronge = (blow(law).impulse for law in COLOURS)
    assert newton == pytest.approx(sticking(newton[0]))  # no slip,
    assert newton == pytest.approx(compressed(newton[1], -E * SPEED[1]))  # and e times the speed of the approach
    half = blow("poisson", restitution=0.0).impulse
    assert half == pytest.approx(sticking(half[0]))
    assert half == pytest.approx(compressed(half[1]))
    assert poisson == pytest.approx(((1.0 + E) * half[0], half[1] + MU * E * half[0]))
    turn, middle = turning_point(), blow("stronge", restitution=0.0).impulse
    assert turn == pytest.approx(sticking(turn[0]))
    assert middle == pytest.approx(compressed(middle[1]))
    for point in (middle, stronge):
        assert point[1] - turn[1] == pytest.approx(MU * (point[0] - turn[0]))

    def work(start: tuple[float, float], end: tuple[float, float]) -> float:
        speeds = [SPEED[1] + G_NN * normal + G_NT * along for normal, along in (start, end)]
        return 0.5 * sum(speeds) * (end[0] - start[0])

    compression = work((0.0, 0.0), turn) + work(turn, middle)
    assert work(middle, stronge) == pytest.approx(-(E**2) * compression)


@pytest.mark.parametrize("friction", [0.8, 1.3, 1.45, 1.6, 2.5])
def test_the_regions_have_as_many_solutions_as_the_engine_finds(friction: float) -> None:
    kinds = {"one": ["backwards"], "lifts": ["open"], "none": [], "two": ["backwards", "open"]}
    seen = set()
    for degrees, rate in product((15, 35, 50, 63, 75, 85), (0.0, 3.0, 4.3, 5.5, 6.8)):
        angle = math.radians(degrees)
        found = friction_solutions(rod(angle, rate, friction))
        modes = sorted("open" if one.modes["floor"] == "open" else one.modes["floor"].split()[-1] for one in found)
        kind = solutions(angle, rate, friction)
        assert modes == kinds[kind], (degrees, rate)
        seen.add(kind)
    assert seen == (set(kinds) if friction > 4.0 / 3.0 else {"one", "lifts"})


def test_motions_end_at_the_point_where_both_vanish_or_lift_off() -> None:
    angle, _ = critical_angles(1.6)
    assert critical_friction(angle) == pytest.approx(1.6, rel=1e-12)
    assert critical_rate(math.pi / 2) == pytest.approx(math.sqrt(2.0 * GRAVITY))
    jammed = 0
    for start in STARTS:
        last = motion(*start)[-1]
        jammed += last == pytest.approx((math.degrees(angle), critical_rate(angle)), rel=1e-9)
        assert last[1] <= critical_rate(math.radians(last[0])) * (1.0 + 1e-9)
    assert jammed == 3
