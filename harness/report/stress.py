"""Charts of the bending stress that one impact leaves."""

from __future__ import annotations

from ..numbers import engineering
from ..tooth_stress import StressField
from .plot import Curve, Plot
from .style import COLOURS, IMPACT_COLOUR


def stress_plots(field: StressField) -> tuple[Plot, Plot]:
    """Stress along the tooth (when it is largest, and its envelope) and in time (where it is largest)."""
    envelope = abs(field.stress).max(axis=1)
    maximum = field.maximum
    peak = f"{engineering(maximum.stress, 'Pa')} at x/l = {maximum.position:.4f}"

    def mark(x: float) -> Curve:
        return Curve(peak, [x], [maximum.stress], IMPACT_COLOUR, line=False, dots=True)

    when = f"{engineering(maximum.time, 's')} after the impact"
    along = [
        Curve("largest at any time", field.position, envelope, "#9aa5b1"),
        Curve(when, field.position, field.along, COLOURS[0]),
        mark(maximum.position),
    ]
    in_time = [
        Curve(f"at x/l = {maximum.position:.4f}", 1e6 * field.delay, field.in_time, COLOURS[2]),
        mark(1e6 * maximum.time),
    ]
    return (
        Plot("Along the tooth", "x / length, from the root [1]", "bending stress [Pa]", along),
        Plot("In time", "time since the impact [µs]", "bending stress [Pa]", in_time),
    )
