"""Periodic motions whose beginning and multipliers are known: by closed forms, or found in another way."""

import cmath
import importlib.util
import math
import runpy
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    MechanismError,
    Model,
    Output,
    Parameter,
    PointLineContact,
    SpringDamper,
    Translational,
    YDriver,
    harmonic_motion,
    rigid_body,
)
from mechanism_fmu.periodic import CycleError, GrazingError, Section, find_cycle, problem_of, section_of

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
G = 9.81

# A block of 1 kg on a spring, whose other end is driven: x" + 2 d x' + k x = k a sin(w t).
STIFFNESS, DAMPING, AMPLITUDE, FREQUENCY = 100.0, 2.0, 0.01, 7.0


def oscillator(values: SimpleNamespace) -> Mechanism:
    block = rigid_body("block", (0.0, values.block_start), mass=1.0, inertia=1.0, velocity=(0.0, values.rate))
    base = rigid_body("base", (0.0, -1.0), mass=1.0, inertia=1.0, velocity=(0.0, AMPLITUDE * FREQUENCY))
    up = GROUND.line((0, 0), (0, 1))
    joints = (
        Translational("guide", up, block.line((0, 0), (0, 1))),
        Translational("base_guide", up, base.line((0, 0), (0, 1))),
        YDriver("drive", base.at(0, 0), motion=harmonic_motion(-1.0, AMPLITUDE, FREQUENCY)),
    )
    spring = SpringDamper("spring", block.at(0, 0), base.at(0, 0), stiffness=STIFFNESS, free_length=1.0)
    air = SpringDamper("air", block.at(0, 0), GROUND.at(0, -9), damping=values.damping)
    # a ceiling, far away unless said otherwise
    stop = PointLineContact("stop", block.at(0, 0), GROUND.line((0, values.ceiling), (-1, 0)), restitution=0.5)
    outputs = (Output("block", block.y, "", "m"), Output("block_rate", "block.y_rate", "", "m/s"))
    return Mechanism((block, base), joints, (spring, air), (stop,), outputs=outputs)


OSCILLATOR = Model(
    "Oscillator",
    "Block on a driven spring",
    (
        Parameter("block_start", 0.0, "", "m"),
        Parameter("rate", 0.0, "", "m/s"),
        Parameter("damping", DAMPING, "", "N.s/m"),
        Parameter("ceiling", 1.0, "", "m"),
    ),
    oscillator,
)
PERIOD = 2.0 * math.pi / FREQUENCY
#: Of the steady motion x = Im(X exp(i w t)).
STEADY = STIFFNESS * AMPLITUDE / (STIFFNESS - FREQUENCY**2 + 1j * DAMPING * FREQUENCY)
UNKNOWNS = ("block_start", "rate=block_rate")


def test_multipliers_of_a_damped_oscillator_are_exponentials() -> None:
    found = find_cycle(problem_of(OSCILLATOR, UNKNOWNS), PERIOD)
    np.testing.assert_allclose(found.start, [STEADY.imag, (1j * FREQUENCY * STEADY).imag], atol=1e-10)
    exponent = -0.5 * DAMPING + 1j * math.sqrt(STIFFNESS - 0.25 * DAMPING**2)
    exact = cmath.exp(exponent * PERIOD)
    ours = found.multipliers[np.argsort(found.multipliers.imag)]
    np.testing.assert_allclose(ours, sorted([exact, exact.conjugate()], key=lambda m: m.imag), atol=1e-8)
    assert np.all(found.errors < 1e-7)
    assert found.stable
    assert not found.events


def test_without_damping_stability_is_undecided() -> None:
    """The multipliers are on the unit circle."""
    found = find_cycle(problem_of(OSCILLATOR, UNKNOWNS, ["damping=0"]), PERIOD)
    np.testing.assert_allclose(np.abs(found.multipliers), 1.0, atol=1e-8)
    assert not found.stable
    assert found.undecided


@pytest.mark.parametrize(
    "guess",
    [[f"block_start={STEADY.imag!r}", f"rate={(1j * FREQUENCY * STEADY).imag!r}"], []],
    ids=["from there", "from elsewhere"],
)
def test_grazing_is_refused_by_name(guess: list[str]) -> None:
    """The ceiling is where the steady motion turns."""
    with pytest.raises(GrazingError, match=r"Grazing: within .* the order of events\s+changes: .*stop\.gap") as refused:
        find_cycle(problem_of(OSCILLATOR, UNKNOWNS, [f"ceiling={abs(STEADY)!r}", *guess]), PERIOD)
    assert "Change a parameter so that this contact clearly strikes or clearly misses" in str(refused.value)


# A ball that bounces on a plate which swings, once in each period.
PLATE, E, OMEGA = 0.012, 0.5, 30.0
T = 2.0 * math.pi / OMEGA


def bouncing(values: SimpleNamespace) -> Mechanism:
    ball = rigid_body("ball", (0.0, values.height), mass=1.0, inertia=1.0, velocity=(0.0, values.rate))
    plate = rigid_body("plate", mass=1.0, inertia=1.0, velocity=(0.0, PLATE * OMEGA))
    joints = (
        Translational("guide", GROUND.line((0, 0), (0, 1)), plate.line((0, 0), (0, 1))),
        YDriver("drive", plate.at(0, 0), motion=harmonic_motion(0.0, PLATE, OMEGA)),
    )
    top = PointLineContact("top", ball.at(0, 0), plate.line((0, 0), (1, 0)), restitution=E)
    return Mechanism((ball, plate), joints, contacts=(top,), gravity=(0.0, -G))


BOUNCING = Model(
    "Bouncing",
    "Ball on a plate that swings",
    (Parameter("height", 0.05, "", "m"), Parameter("rate", 0.0, "", "m/s")),
    bouncing,
)
#: Speed of the plate when it is struck: g T / 2 + e g T / 2 over 1 + e is that of the ball relative to it.
STRUCK_AT = (1.0 - E) / (1.0 + E) * G * T / 2.0


@pytest.mark.parametrize("side", [1.0, -1.0], ids=["upwards", "downwards"])
def test_multipliers_of_a_bouncing_ball_are_those_of_its_map(side: float) -> None:
    """The closed form of the map (time, speed) at an impact; one of two phases is stable, the other a saddle."""
    phase = side * math.acos(STRUCK_AT / (PLATE * OMEGA))
    time = phase / OMEGA % T
    before, leaves = T - time, G * T / 2.0
    height = PLATE * math.sin(phase) + leaves * before - 0.5 * G * before**2
    guess = [f"height={height + 1e-5!r}", f"rate={leaves - G * before!r}"]
    found = find_cycle(problem_of(BOUNCING, ["ball.y", "ball.y_rate"], guess), T)
    np.testing.assert_allclose(found.start, [height, leaves - G * before], atol=1e-9)
    assert [event.guard for event in found.events] == ["top.gap"]
    assert found.events[0].time == pytest.approx(time, abs=1e-9)

    acceleration = -PLATE * OMEGA**2 * math.sin(phase)
    later = T / (leaves + STRUCK_AT)  # d(time of flight) / d(speed)
    matrix = [[1.0, later], [(1 + E) * acceleration, -E + (E * G + (1 + E) * acceleration) * later]]
    exact = np.linalg.eigvals(np.array(matrix))
    key = {"key": lambda m: (round(m.real, 9), m.imag)}
    np.testing.assert_allclose(
        sorted(found.multipliers.tolist(), **key), sorted(exact.tolist(), **key), rtol=0, atol=1e-8
    )
    assert np.prod(found.multipliers) == pytest.approx(E * E, abs=1e-8)
    assert found.stable == (side > 0.0)
    assert not found.undecided


def test_the_woodpeckers_multiplier_is_that_of_other_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the program of the explanation, which ends its cycles by a secant of its own, at its own tolerance."""
    spec = importlib.util.spec_from_file_location("woodpecker_cycle", EXAMPLES / "woodpecker_cycle.py")
    assert spec is not None
    assert spec.loader is not None
    other = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "woodpecker_cycle", other)
    spec.loader.exec_module(other)

    model = runpy.run_path(str(EXAMPLES / "gallery" / "woodpecker.py"))["MODEL"]
    found = find_cycle(problem_of(model, ["start=bird"]), Section("bird_rate"))
    assert found.period == pytest.approx(0.13074752, abs=5e-9)
    assert found.stable
    start, apart = float(found.start[0]), 1e-4
    low, high = (other.cycle(start + side * apart, "newton", 1e-11).end["bird"] for side in (-0.5, 0.5))
    assert found.multipliers[0] == pytest.approx((high - low) / apart, abs=1e-6)
    assert found.moved.keys() == {"sleeve.y", "bird.y"}


def test_the_ratchet_feed_forgets_in_one_stroke() -> None:
    """It goes on by a tooth each stroke, and where a stroke ends does not depend on where it began."""
    model = runpy.run_path(str(EXAMPLES / "feed_ratchet.py"))["MODEL"]
    unknowns = ["wheel.angle", "wheel.speed", "pawl.angle", "pawl.speed"]
    found = find_cycle(problem_of(model, unknowns, (), ["wheel.angle=30deg"]), 1.0, settle=5)
    assert found.stable
    assert np.all(np.abs(found.multipliers) < 1e-7)
    assert found.moved["wheel.angle"] == pytest.approx(math.radians(30), abs=1e-9)


def test_what_is_left_out_and_does_not_return_is_named() -> None:
    """The block is where it was, but its speed is not."""
    with pytest.raises(CycleError, match=r"the next cycle is another one.*block\.y_rate by"):
        find_cycle(problem_of(OSCILLATOR, ["block_start"], ["rate=0.1"]), PERIOD)


def test_a_section_that_is_not_passed_is_refused() -> None:
    problem = problem_of(OSCILLATOR, ["block_start"], ["rate=0.1"])
    with pytest.raises(CycleError, match=r"block passes 0 rising \d times within 0\.2 s, which is no\s+whole cycle"):
        find_cycle(problem, section_of(problem, "block", "rising", passages=5, longest=0.2))


def test_a_beginning_off_the_section_is_refused() -> None:
    problem = problem_of(OSCILLATOR, ["block_start"])
    with pytest.raises(MechanismError, match=r"must begin on the section block_rate = 0\.1, but there it is 0\."):
        find_cycle(problem, section_of(problem, "block_rate=0.1m/s", "rising"))


def test_a_beginning_with_closed_outlines_is_refused() -> None:
    model = runpy.run_path(str(EXAMPLES / "feed_ratchet.py"))["MODEL"]
    with pytest.raises(CycleError, match="Closed at the beginning of the cycle: tooth"):
        find_cycle(problem_of(model, ["wheel.angle"], ["phase=180deg"], ["wheel.angle=30deg"]), 1.0, settle=2)


@pytest.mark.parametrize(
    ("unknowns", "settings", "advances", "said"),
    [
        (["weight"], [], [], "There is no parameter 'weight' to be unknown"),
        (["block.z"], [], [], r"There is no 'block\.z' to be unknown; of bodies there are: block\.x, "),
        (["rate"], [], [], "is compared at the end of the cycle with the output 'rate', which is not there"),
        (["rate=block"], [], [], "rate in m/s cannot be compared with block in m"),
        ([], ["damping"], [], "write --set NAME=VALUE"),
        ([], ["damping=1m"], [], "damping wants"),
        ([], ["mass=1"], [], "has no parameter 'mass'"),
        ([], [], ["base.y=1"], r"base\.y advances, but is not unknown; unknown: block_start"),
    ],
)
def test_what_cannot_be_asked_is_refused(
    unknowns: list[str], settings: list[str], advances: list[str], said: str
) -> None:
    with pytest.raises(MechanismError, match=said):
        problem_of(OSCILLATOR, unknowns, settings, advances)


def test_a_model_without_start_parameters_says_what_could_be_unknown() -> None:
    with pytest.raises(MechanismError, match=r"say what is unknown.*ball\.x, ball\.y, ball\.angle"):
        problem_of(BOUNCING)
