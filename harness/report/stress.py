"""Charts of the bending stress that one impact leaves."""

from __future__ import annotations

import pandas as pd

from mechanism_fmu.stress import MaterialCard, WedgeTooth, beam_theory_note

from ..numbers import engineering
from ..tooth_stress import StressField, stress_field, worst_impact
from .interactive import interactive
from .page import chart, charts, section
from .plot import Curve, Plot
from .style import COLOURS, IMPACT_COLOUR

_HELD = (
    "The wheel was held in every impact: its speed did not jump, so that its teeth do not ring. The push of the pawl "
    "on the struck tooth's root is not in this stress."
)


def stress_section(
    impacts: pd.DataFrame, tooth: WedgeTooth, card: MaterialCard, heading: str = "Bending stress in the tooth"
) -> str:
    """The stress that the impact leaves which leaves the largest; "" without an impact."""
    if impacts.empty:
        return ""
    place = worst_impact(impacts)
    if place is None:
        return section(heading, note=_HELD)
    worst = impacts.iloc[place]
    note = (
        f"The impact with the largest stress: t = {worst['time']:.9g} s, "
        f"v_I = {engineering(float(worst['velocity']), 'm/s')};"
        f" wedge of length {tooth.length * 1e3:.4g} mm and apex angle {tooth.apex_angle:.4g} rad,"
        f" {card.name}, the paper's two Ritz modes."
    )
    note += f" {beam_theory_note(tooth)}"
    note += " v_I is the length of the tooth times the jump of the wheel's speed at that instant."
    plots = stress_plots(stress_field(tooth, worst["velocity"], card.material))
    return section(heading, charts(*(chart(interactive(plot, height=400)) for plot in plots)), note=note)


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
