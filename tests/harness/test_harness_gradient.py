"""Derivatives of what an impact leaves: those of the ratchet by everything, and those of a falling ball.

Those of the ratchet are compared with plain Richardson differences of another program: its mechanism, simulated at a
tolerance of 1e-12 with steps chosen by hand, and `mechanism_fmu.stress` of the jump of the wheel's speed.
"""

import json
import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from typer.testing import CliRunner

import build_fmu
import models
from harness.app.cli import main
from harness.designs import by_batch, by_fmu
from harness.designs.task import Design, Task
from harness.fmu import open_fmu
from harness.run.master import TimeGrid
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.stress import STEEL, WedgeTooth, maximum_stress
from models.ratchet.start import tooth

Array = npt.NDArray[np.float64]

#: A ball that falls from a height; it strikes at sqrt(2 h / g) with sqrt(2 g h).
BALL = """
from mechanism_fmu.model import (
    GROUND, Body, Mechanism, Model, Output, Parameter, PointLineContact, impact_outputs, length_parameter,
    settings_parameters,
)

def mechanism(values):
    ball = Body("ball", 1.0, 1.0, (0.0, values.height, 0.0))
    face = GROUND.line((0, 0), (1, 0))
    floor = PointLineContact("floor", ball.at(0, 0), face, restitution=values.restitution)
    fields = (Output("closing_speed", "closing_speed", "{impact}", "m/s"),)
    outputs = (Output("above", "ball.y", "Above the floor", "m"), *impact_outputs("Impacts", fields))
    return Mechanism((ball,), contacts=(floor,), outputs=outputs, gravity=(0.0, -values.gravity))

PARAMETERS = (
    length_parameter("height", 1.0, "From which it falls"),
    Parameter("gravity", 9.81, "Acceleration", "m/s2", 0.0, 100.0),
    Parameter("restitution", 0.5, "Of the floor", "1", 0.0, 1.0),
    *settings_parameters(),
)
MODEL = Model("Ball", "Ball that falls", PARAMETERS, mechanism, stop_time=0.6)
"""
#: What counts nothing: a ball above a floor, which it strikes after sqrt(h / 5 m) s; a wheel on a brake.
UNCOUNTED = """
from mechanism_fmu.model import *

def mechanism(values):
    ball = rigid_body("ball", (0, values.h), mass=1.0, inertia=1.0)
    floor = PointLineContact("floor", ball, GROUND.line((0, 0), (1, 0)), restitution=0.5)
    wheel = rigid_body("wheel", (5.0, 0.0), mass=1.0, inertia=1.0)
    hinge = Revolute("hinge", wheel.at(0, 0), GROUND.at(5.0, 0.0))
    forces = (Torque("drive", wheel, torque=values.torque), Brake("brake", wheel, limit=2.0))
    outputs = (Output("y", ball.y, "Height", "m"), Output("a", wheel.angle, "Angle", "rad"))
    return Mechanism((ball, wheel), (hinge,), forces, (floor,), outputs=outputs, gravity=(0.0, -10.0))

PARAMETERS = (
    length_parameter("h", 5.0, "From which it falls"),
    Parameter("torque", 1.0, "Of the drive", "N.m", -10.0, 10.0),
    *settings_parameters(),
)
MODEL = Model("Uncounted", "Events that no output counts", PARAMETERS, mechanism, stop_time=1.0)
"""
RATCHET = models.load("ratchet").MODEL
QUANTITIES = ("first_impact.time", "first_impact.wheel_speed", "first_impact.stress_max")
#: Of variables that are 0: whether they may be less, and the largest step [their units].
AT_ZERO = {
    "spring_preload": (True, 1e-4),
    "load_torque": (True, 1e-4),
    "drive_angle": (True, 1e-2),
    "drive_speed": (True, 1e-2),
    "pawl_spring_torque": (True, 1e-5),
    "pawl_angle_start": (True, 1e-2),
    "holding_pawl_restitution": (False, 1e-2),
    "wheel_damping": (False, 1e-3),
    "drive_stiffness": (False, 4e-5),
    "drive_damping": (False, 2e-5),
    "joint_friction_radius": (False, 1e-4),
}
#: Of all others: the largest step over their value, where 4e-3 is too far.
STEPS = {"crank_angle_start": 1e-3, "hinge_distance": 1e-3, "crank_length": 1e-3, "pawl_length": 1e-3}
#: They change nothing up to the first impact and in its stress: exactly.
WITHOUT_EFFECT = {
    "holding_pawl_restitution": QUANTITIES,
    "pawl_angle_start": QUANTITIES,
    "drive_angle": QUANTITIES,
    "drive_speed": QUANTITIES,
    "elastic_modulus": QUANTITIES,
    "pawl_width": QUANTITIES,
    "pawl_depth": QUANTITIES,
    "crank_width": QUANTITIES,
    "crank_depth": QUANTITIES,
}


def gradient(*arguments: str | Path) -> dict[str, dict[str, dict[str, float]]]:
    done = CliRunner().invoke(main, ["gradient", *map(str, arguments), "--json"])
    assert done.exit_code == 0, done.output
    found: dict[str, dict[str, dict[str, float]]] = json.loads(done.stdout)
    return found


def of_the_ratchet(name: str, value: float) -> Array:
    """The three quantities with one parameter or input changed."""
    inputs = {port.name: port.start for port in RATCHET.build(RATCHET.values()).inputs}
    changed = {} if name in inputs else {name: value}
    values = RATCHET.values(relative_tolerance=1e-12, **changed)
    if name in inputs:
        inputs[name] = value
    simulation = Simulation(RATCHET.build(values), inputs=list(inputs.values()))
    simulation.advance(1.2)
    (impact,) = simulation.impacts_in_step()
    seen = simulation.read()
    after, before = seen["impact_wheel_speed"], seen["impact_wheel_speed_before"]
    struck = tooth(values)
    wedge = WedgeTooth(struck.beam_length, struck.apex_angle)
    velocity = struck.beam_length * abs(after - before)
    return np.array([impact.time, after, maximum_stress(wedge, STEEL, velocity).stress])


def richardson(function: Callable[[float], Array], x: float, step: float, both_sides: bool) -> Array:
    """From four steps, each half as large as the last."""
    steps = [step / 2.0**k for k in range(4)]
    if both_sides:
        rows = [(function(x + h) - function(x - h)) / (2.0 * h) for h in steps]
    else:
        here = function(x)
        rows = [(function(x + h) - here) / h for h in steps]
    for order in range(1, len(steps)):
        factor = 2.0 ** (2 * order if both_sides else order)
        rows = [(factor * finer - coarse) / (factor - 1.0) for coarse, finer in pairwise(rows)]
    return rows[0]


@pytest.fixture(scope="module")
def ratchet() -> dict[str, dict[str, dict[str, float]]]:
    asked = [word for quantity in QUANTITIES for word in ("--of", quantity)]
    return gradient("ratchet", *asked, "--stop-time", "1.2s")


def test_every_smooth_variable_of_the_ratchet_is_there(ratchet) -> None:
    real = [p.name for p in RATCHET.parameters if p.type == "Real"]
    real += [port.name for port in RATCHET.build(RATCHET.values()).inputs]
    left_out = {"baumgarte_alpha", "baumgarte_beta", "relative_tolerance"}
    assert set(ratchet["variables"]) == set(real) - left_out
    assert set(ratchet["none"]) == {"friction", "restitution"}
    assert [ratchet["quantities"][one]["unit"] for one in QUANTITIES] == ["s", "rad/s", "Pa"]


def test_the_derivatives_of_the_ratchet_are_those_of_another_program(ratchet) -> None:
    """Within 1e-6 of each, and 1e-9 of the quantity over the variable."""
    middle = np.array([ratchet["quantities"][one]["value"] for one in QUANTITIES])
    compared = 0
    for name, value in ratchet["variables"].items():
        if name in ratchet["none"]:
            continue
        both_sides, step = AT_ZERO[name] if value == 0.0 else (True, STEPS.get(name, 4e-3) * value)
        expected = richardson(lambda x, name=name: of_the_ratchet(name, x), value, step, both_sides)
        found = np.array([ratchet["derivatives"][one][name] for one in QUANTITIES])
        scale = np.abs(middle) / abs(value or step)
        allowed = 1e-6 * np.abs(expected) + 1e-9 * scale
        assert (np.abs(found - expected) <= allowed).all(), (name, found, expected)
        compared += 1
    assert compared == 33


def test_what_has_no_effect_has_the_derivative_0_exactly(ratchet) -> None:
    without = {
        name: tuple(one for one in QUANTITIES if ratchet["derivatives"][one][name] == 0.0)
        for name in ratchet["variables"]
        if name not in ratchet["none"]
    }
    assert {name: ones for name, ones in without.items() if ones} == WITHOUT_EFFECT
    for one in QUANTITIES:  # the mass of the heaviest body sets the scale of errors, and so the last digits of all
        assert abs(ratchet["derivatives"][one]["wheel_mass"]) <= ratchet["errors"][one]["wheel_mass"]


@pytest.mark.parametrize(("height", "g"), [(1.0, 9.81), (0.02, 1.62)])
def test_a_falling_ball_has_closed_forms(height: float, g: float, tmp_path: Path) -> None:
    file = tmp_path / "ball.py"
    file.write_text(BALL, encoding="utf-8")
    time, speed = math.sqrt(2.0 * height / g), math.sqrt(2.0 * g * height)
    of = ["--of", "first_impact.time", "--of", "first_impact.closing_speed"]
    at = ["--set", f"height={height}", "--set", f"gravity={g}", "--stop-time", str(1.2 * time)]
    found = gradient(file, *of, "--by", "height", "--by", "gravity", *at)
    assert found["quantities"]["first_impact.time"]["value"] == pytest.approx(time, rel=1e-12)
    derivatives = found["derivatives"]
    assert derivatives["first_impact.time"]["height"] == pytest.approx(0.5 * time / height, rel=1e-8)
    assert derivatives["first_impact.time"]["gravity"] == pytest.approx(-0.5 * time / g, rel=1e-8)
    assert derivatives["first_impact.closing_speed"]["height"] == pytest.approx(g / speed, rel=1e-8)
    assert derivatives["first_impact.closing_speed"]["gravity"] == pytest.approx(height / speed, rel=1e-8)
    assert found["relative"]["first_impact.time"] == pytest.approx({"height": 0.5, "gravity": -0.5}, rel=1e-8)


@pytest.fixture(scope="module")
def uncounted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("uncounted") / "uncounted.py"
    file.write_text(UNCOUNTED, encoding="utf-8")
    return file


@pytest.mark.parametrize(("height", "slope"), [(5.1, 1.0), (4.99999, -0.4999985), (4.9, -0.485075)])
def test_beside_an_event_the_slope_is_that_of_its_side(height: float, slope: float, uncounted: Path) -> None:
    """Before it has struck, y = h - 5 m; then y = v (1 - t) / 2 - ..., v = 10 t."""
    time = math.sqrt(height / 5.0)
    if time < 1.0:  # y = 5 t (1 - t) - 5 (1 - t)^2, t' = 1/(10 t)
        slope = (15.0 - 20.0 * time) / (10.0 * time)
    found = gradient(uncounted, "--of", "end.y", "--by", "h", "--set", f"h={height}")
    assert found["derivatives"]["end.y"]["h"] == pytest.approx(slope, abs=1e-7)
    assert abs(found["derivatives"]["end.y"]["h"] - slope) <= found["errors"]["end.y"]["h"] + 1e-9


@pytest.mark.parametrize(
    ("of", "by", "setting", "reason"),
    [
        ("end.y", "h", "h=5.0000001", "the end comes next, but beside it floor.gap"),
        ("end.y", "h", "h=5", "comes next, but beside it"),
        ("end.a", "torque", "torque=2", "brake sticks at the start"),
    ],
)
def test_across_an_event_that_nothing_counts_there_is_none(
    of: str, by: str, setting: str, reason: str, uncounted: Path
) -> None:
    arguments = ["gradient", str(uncounted), "--of", of, "--by", by, "--set", setting, "--json"]
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 1
    found = json.loads(done.stdout)
    assert found["derivatives"][of][by] is None
    assert reason in found["none"][by]


def test_an_fmu_names_the_same_events_in_its_log(uncounted: Path, tmp_path: Path) -> None:
    path = build_fmu.built(str(uncounted), tmp_path)
    with open_fmu(path) as fmu:
        task = Task(TimeGrid.of(1.2, 0.1), {}, None, (), events=True)
        designs = [Design(1, {"h": 5.0}), Design(2, {"h": 8.0})]
        by_calls = by_fmu.run_designs(fmu, task, designs)
        at_once = by_batch.run_designs(fmu, task, designs)
    assert [result.events for result in by_calls] == [("floor.gap",), ()]
    assert [result.events for result in at_once] == [
        ("brake sticks at the start", *result.events) for result in by_calls
    ]
