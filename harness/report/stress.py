"""Charts of the bending stress that one impact leaves."""

from __future__ import annotations

import pandas as pd

from mechanism_fmu.stress import Beam, MaterialCard, beam_theory_note
from mechanism_fmu.stress.tooth import beam_in_words

from ..declared import Struck
from ..numbers import engineering
from ..tooth_stress import StressField, stress_field, worst_impact
from .interactive import interactive
from .page import chart, charts, section
from .plot import Curve, Plot
from .style import COLOURS, IMPACT_COLOUR

_HELD = (
    "The {body} was held in every impact: its speed did not jump, so that its {plural} do not ring. The push of the "
    "{striker} on the struck {name}'s root is not in this stress."
)


def stress_section(impacts: pd.DataFrame, struck: Struck, beam: Beam, card: MaterialCard, heading: str = "") -> str:
    """The stress that the impact leaves which leaves the largest; "" without an impact.

    Args:
        impacts: as of `tooth_stress.with_stress`.
        struck: what they strike, in words.
        beam: the same as a beam.
        card: its material.
        heading: of the section; "": by what is struck.
    """
    heading = heading or f"Bending stress in the {struck.name}"
    if impacts.empty:
        return ""
    place = worst_impact(impacts)
    if place is None:
        words = {"body": struck.body, "striker": struck.striker, "name": struck.name, "plural": struck.plural}
        return section(heading, note=_HELD.format(**words))
    worst = impacts.iloc[place]
    note = (
        f"The impact with the largest stress: t = {worst['time']:.9g} s, "
        f"v_I = {engineering(float(worst[struck.jump]), 'm/s')};"
        f" {beam_in_words(beam)}, {card.name}, the paper's two Ritz modes."
    )
    note += f" {beam_theory_note(beam)}"
    note += f" v_I is the length of the {struck.name} times the jump of the {struck.body}'s speed at that instant."
    plots = stress_plots(stress_field(beam, worst[struck.jump], card.material), struck.name)
    return section(heading, charts(*(chart(interactive(plot, height=400)) for plot in plots)), note=note)


def stress_plots(field: StressField, name: str) -> tuple[Plot, Plot]:
    """Stress along what has this name (when it is largest, and its envelope) and in time (where it is largest)."""
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
        Plot(f"Along the {name}", "x / length, from the root [1]", "bending stress [Pa]", along),
        Plot("In time", "time since the impact [µs]", "bending stress [Pa]", in_time),
    )
