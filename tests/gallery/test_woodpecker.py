"""The woodpecker toy: its limit cycles against an oracle, and against what has been published of them."""

from __future__ import annotations

import importlib.util
import sys
from dataclasses import replace

import numpy as np
import pytest
from gallery_examples import GALLERY, simulation
from scipy.optimize import root_scalar
from woodpecker_oracle import BIRD, CENTRE, GRAVITY, PIN, SLEEVE, STIFFNESS, Toy

from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation

_SPEC = importlib.util.spec_from_file_location("woodpecker_cycle", GALLERY.parent / "woodpecker_cycle.py")
assert _SPEC is not None
assert _SPEC.loader is not None
program = importlib.util.module_from_spec(_SPEC)
sys.modules["woodpecker_cycle"] = program  # where its records are looked up
_SPEC.loader.exec_module(program)


def oracle(law: str, linear: bool, guess: float) -> tuple[float, float, float, list[tuple[float, str, float]]]:
    """Bird at rest [rad], period [s], height after it [m], and events of the limit cycle."""
    found = root_scalar(lambda s: Toy(s, law, linear).cycle()[1] - s, x0=guess, x1=guess + 1e-4, xtol=1e-12)
    toy = Toy(found.root, law, linear)
    period, _, height = toy.cycle()
    return found.root, period, height, toy.events


@pytest.mark.parametrize("law", ["newton", "poisson"])
def test_its_limit_cycle_is_that_of_the_oracle(law: str) -> None:
    start, period, height, events = oracle(law, False, program.GUESS[law])
    for tolerance, off in ((1e-9, 2e-9), (1e-11, 2e-11)):
        found, residual, slope = program.limit_cycle(law, tolerance)
        assert abs(residual) < 1e-12
        assert abs(slope) < 0.2  # it attracts
        np.testing.assert_allclose([found.start, found.period], [start, period], rtol=0, atol=off)
        np.testing.assert_allclose(found.end["height"], height, rtol=0, atol=off)
        assert [name for _, name, _ in found.events] == [name for _, name, _ in events]
        for (time, name, speed), (its_time, _, its_speed) in zip(found.events, events, strict=True):
            # a contact lets go where it would pull by 2e-9 N, up to 0.6 ns after the oracle's
            assert abs(time - its_time) < off + (1e-9 if name.endswith(".force") else 0.0), name
            assert abs(speed - its_speed) < 50 * off, name
        rates = [found.end[name] for name in ("fall", "sleeve_rate", "bird_rate")]
        np.testing.assert_allclose(rates, 0.0, atol=1e-8)


@pytest.mark.parametrize("law", ["newton", "poisson"])
def test_with_small_angles_it_is_the_paper_s(law: str) -> None:
    """The paper prints a period of 0.1452 s, a lowest angle of -0.53 rad, and this order of events."""
    start, period, height, events = oracle(law, True, -0.5295)
    found, residual, slope = program.limit_cycle(law, 1e-11, program.SMALL_ANGLES)
    assert abs(residual) < 1e-9
    assert -1.0 < slope < 0.0  # it attracts slowly
    np.testing.assert_allclose([found.start, found.period], [start, period], rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.end["height"], height, rtol=0, atol=1e-6)
    assert [name for _, name, _ in found.events] == [name for _, name, _ in events]
    strikes = [name for _, name, speed in found.events if speed]
    assert strikes[:4] == ["top.gap", "beak.gap", "top.gap", "bottom.gap"]
    assert abs(found.start - -0.53) < 0.005
    assert abs(found.period - 0.1452) < 0.001


@pytest.mark.parametrize(("law", "start"), [("newton", -0.53), ("poisson", -0.44), ("stronge", -0.48)])
def test_other_starts_lead_to_it(law: str, start: float) -> None:
    wanted, *_ = program.limit_cycle(law, 1e-9)
    for _ in range(12):
        start = program.cycle(start, law, 1e-9).end["bird"]
    assert abs(start - wanted.start) < 1e-8


@pytest.mark.parametrize("law", ["newton", "poisson", "stronge"])
def test_what_it_falls_is_what_friction_and_impacts_take(law: str) -> None:
    found, *_ = program.limit_cycle(law, 1e-9)
    lost = (Output("lost", "energy.lost", "By friction and impacts", "J"),)
    running = Simulation(replace(program.toy(found.start, law, 1e-9), outputs=lost))
    running.advance(found.period)
    assert running.read()["lost"] == pytest.approx(-(SLEEVE + BIRD) * GRAVITY * found.end["height"], rel=1e-9)


@pytest.mark.parametrize(("friction", "holds"), [(0.2855, 1.0), (0.2845, 0.0)])
def test_it_hangs_on_the_pole_from_the_published_friction_on(friction: float, holds: float) -> None:
    """At rest the bird hangs at -0.2216 rad as printed, phi_M - m g l / c; that needs mu >= 0.285."""
    rest = -0.6 / 5.8 - BIRD * GRAVITY * CENTRE / STIFFNESS
    assert rest == pytest.approx(-0.2216, abs=1.5e-4)
    force = (BIRD * (PIN + CENTRE) - (SLEEVE + BIRD) * 0.0031) * GRAVITY / 0.0058
    assert (SLEEVE + BIRD) * GRAVITY / force == pytest.approx(0.285, abs=5e-4)
    running = simulation("woodpecker", size=program.SMALL_ANGLES, friction=friction, start=rest)
    running.advance(0.05)
    assert running.read()["jams"] == holds
