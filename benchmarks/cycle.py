"""Cost of a simulated second: the free ratchet that indexes, against real time."""

from __future__ import annotations

import math

from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

from .timing import Comparison, DisagreementError, batch

_PERIOD, _MEAN, _AMPLITUDE = 8.0, math.radians(84.3), math.radians(10.4)
_STOP_TIME, _HOLD = 34.0, 0.01
_CLICKS = 4
_LEAST_RATIO = 20.0


def compare(rounds: int) -> list[Comparison]:
    """Four strokes of the free ratchet, with inputs that change every 10 ms; the baseline is the clock on the wall."""
    return [_compare(restitution, rounds) for restitution in (0.0, 0.5)]


def _compare(restitution: float, rounds: int) -> Comparison:
    def strokes() -> None:
        simulation = _ratchet(restitution)
        for k in range(round(_STOP_TIME / _HOLD)):
            turn = 2 * math.pi / _PERIOD * (k + 0.5) * _HOLD
            simulation.set_input("drive_angle", _MEAN - _AMPLITUDE * math.cos(turn))
            simulation.set_input("drive_speed", _AMPLITUDE * 2 * math.pi / _PERIOD * math.sin(turn))
            simulation.advance((k + 1) * _HOLD)
        if simulation.read()["clicks"] != _CLICKS:
            raise DisagreementError(f"The free ratchet has not gone {_CLICKS} teeth; run the tests.")

    strokes()
    times = tuple(batch(strokes, 1) / _STOP_TIME for _ in range(rounds))
    subject = "one simulated second of the free ratchet (baseline: real time)"
    return Comparison(subject, f"e = {restitution:g}, new input every 10 ms", (1.0,), times, _LEAST_RATIO)


def _ratchet(restitution: float) -> Simulation:
    values = MODEL.values(
        guided=0.0,
        tooth_count=20,
        tooth_slope_angle=math.radians(95),
        drive_stiffness=2.0,
        drive_damping=0.1,
        pawl_spring_torque=5e-3,
        wheel_damping=0.1,
        restitution=restitution,
    )
    simulation = Simulation(MODEL.build(values))
    simulation.set_input("drive_torque", 0.0)
    simulation.set_input("spring_preload", 3e-3)
    return simulation
