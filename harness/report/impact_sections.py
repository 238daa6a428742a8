"""Report of impacts: their table, the stress of the worst, fatigue damage, compliance."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import pandas as pd

from mechanism_fmu.stress import Beam, MaterialCard, SequenceDamage, beam_theory_note
from mechanism_fmu.stress.tooth import beam_in_words

from ..analysis.compliance import Compliance, compliance_units, compliance_values
from ..analysis.impacts import UNITS_OF_STOPS, contact_name
from ..analysis.stress import (
    BY_TWO_MODES,
    HEADINGS,
    StressField,
    damage_note,
    damage_row,
    stress_field,
    stress_history,
    worst_impact,
)
from ..fmu.declared import Chain, Struck
from ..fmu.description import Value
from ..fmu.values import engineering
from .page import chart, charts, folded_if_long, section, table
from .plot import Curve, Plot, interactive, thin
from .style import COLOURS, IMPACT_COLOUR

# The table of impacts.

#: A longer table is in impacts.csv.
_MOST = 100
_BEFORE = "_speed_before"
#: What impacts.csv has besides: place and delay are those of the section on stress, and the remark stands for a stress.
_LEFT_OUT = ("stress_position", "stress_delay", "remark")


def impacts_section(
    impacts: pd.DataFrame, units: Mapping[str, str], heading: str = "Impacts", contacts: Sequence[str] = ()
) -> str:
    """A row for each of the first impacts, with units by column; "" when there are none.

    Args:
        impacts: of a run.
        units: of its columns.
        heading: of the section.
        contacts: their names, in the order of their numbers; () when they are not known.
    """
    if impacts.empty:
        return ""
    left_out = {*_LEFT_OUT, *_speeds_of_others(impacts)}
    names = [str(name) for name in impacts if name not in left_out]
    headings = [_heading(name, units[name]) for name in names]
    shown = impacts.head(_MOST)
    rows = [[_cell(name, value) for name, value in zip(names, row, strict=True)] for row in _rows(shown[names])]
    if "remark" in shown:
        for row, remark in zip(rows, shown["remark"], strict=True):
            row[names.index("stress_max")] = remark or row[names.index("stress_max")]
    if "contact" in names:
        for row, number in zip(rows, shown["contact"], strict=True):
            row[names.index("contact")] = contact_name(int(number), contacts)
    notes = [UNITS_OF_STOPS] if "contact" in names else []
    if "stress_max" in names:
        notes.append(f"Stress of each impact {BY_TWO_MODES}")
    if left_out - {*_LEFT_OUT}:
        notes.append("Speeds of more bodies are in impacts.csv.")
    note = f"The first {_MOST} of {len(impacts)}; all are in impacts.csv." if len(impacts) > _MOST else ""
    note = " ".join([note, *notes]).strip()
    numbered = [[str(i), *row] for i, row in enumerate(rows, 1)]
    drawn = table(["#", *headings], numbered, numeric=range(len(headings) + 1))
    return section(heading, folded_if_long(drawn, len(rows), "impacts"), note=note)


def _speeds_of_others(impacts: pd.DataFrame) -> list[str]:
    """Speeds before and after, of all bodies but the first: they would make the table wider than a page."""
    bodies = [str(name).removesuffix(_BEFORE) for name in impacts if str(name).endswith(_BEFORE)]
    return [f"{body}{suffix}" for body in bodies[1:] for suffix in (_BEFORE, "_speed")]


def _rows(impacts: pd.DataFrame) -> Iterator[tuple[Value, ...]]:
    return impacts.itertuples(index=False, name=None)


def _heading(name: str, unit: str) -> str:
    words = name.replace("_", " ")
    return f"{words} [{unit}]" if unit else words


def _cell(name: str, value: Value) -> str:
    """Times to nine digits, other numbers to five."""
    if not isinstance(value, float):
        return str(value)
    return f"{value:.9g}" if name == "time" else f"{value:.5g}"


# Which impact stresses what is struck most: closing speed, impulse, energy lost, jump and stress side by side.

#: What could be taken for the severity of an impact, and its heading, but for the jump.
_MEASURES = {"closing_speed": "closing speed", "impulse": "impulse", "energy_lost": "energy lost"}
#: Contacts have their own units of these: a stop's are rad/s and N.m.s.
_BY_CONTACT = ("closing_speed", "impulse")
#: The charts show no more impacts of a contact than this.
_MOST_POINTS = 2000

_NOTE = (
    "Only the jump of the {body}'s speed makes its {plural} ring. How fast the contact closes, or what impulse it "
    "takes, says little about it: an impulse that a held {body}, its hinge or another contact bears does not reach the "
    "{plural}."
)


def severity_section(
    impacts: pd.DataFrame, units: Mapping[str, str], struck: Struck | None, names: Sequence[str] = ()
) -> str:
    """The largest impact by each measure and the stress that it leaves; "" for less than two impacts, or no stresses.

    Args:
        impacts: as of `stress.with_stress`.
        units: of its columns.
        struck: what they strike; None when it is not known.
        names: of the contacts, in the order of their numbers; () when they are not known.
    """
    if struck is None or not {"stress_max", struck.jump, "closing_speed"} <= set(impacts) or len(impacts) < 2:
        return ""
    most = float(impacts["stress_max"].max()) if impacts["stress_max"].notna().any() else 0.0
    known = _MEASURES | {struck.jump: f"jump of the {struck.name}'s tip, v_I", "stress_max": "stress"}
    measures = {name: words for name, words in known.items() if name in impacts}
    note = _NOTE.format(body=struck.body, plural=struck.plural)
    contacts = _named(impacts, names)
    rows = []
    for name, words in measures.items():
        parts = contacts if name in _BY_CONTACT and contacts else {"": impacts}
        rows += [_row(name, words, struck.jump, contact, part, units, most) for contact, part in parts.items()]
    headings = ["largest by", "its value", "time [s]", "jump v_I", "stress left", "of the largest stress"]
    plots = [
        _against(name, measures[name], impacts, contacts, units)
        for name in ("closing_speed", "energy_lost")
        if name in measures
    ]
    return section(
        f"Which impact stresses the {struck.name} most",
        table(headings, rows, numeric=range(1, len(headings))),
        charts(*(chart(interactive(plot, height=280)) for plot in plots)),
        note=f"{note} {UNITS_OF_STOPS}" if contacts else note,
    )


def _named(impacts: pd.DataFrame, names: Sequence[str]) -> dict[str, pd.DataFrame]:
    """The impacts of each contact by its name; {} where contacts are not reported."""
    if "contact" not in impacts:
        return {}
    numbers = sorted({int(number) for number in impacts["contact"]})
    return {contact_name(number, names): impacts[impacts["contact"] == number] for number in numbers}


def _row(
    name: str, words: str, jump: str, contact: str, part: pd.DataFrame, units: Mapping[str, str], most: float
) -> list[str]:
    """The largest of the impacts `part`; `most` is the largest stress of all [Pa]."""
    place = int(part[name].abs().fillna(-1.0).to_numpy().argmax())
    size, time, velocity, stress = (float(part[column].iloc[place]) for column in (name, "time", jump, "stress_max"))
    # The unit in the buffer is that of points on lines; stops and locks have another one.
    value = f"{abs(size):.4g}" if contact else engineering(abs(size), units[name])
    return [
        words + (f", {contact}" if contact else ""),
        value,
        f"{time:.9g}",
        engineering(velocity, units[jump]),
        str(part["remark"].iloc[place]) if math.isnan(stress) else engineering(stress, "Pa"),
        "–" if math.isnan(stress) or most == 0.0 else f"{stress / most:.1%}",
    ]


def _against(
    name: str, words: str, impacts: pd.DataFrame, contacts: Mapping[str, pd.DataFrame], units: Mapping[str, str]
) -> Plot:
    """Stress over another measure, a colour for each contact."""
    curves = []
    for k, (label, part) in enumerate((contacts or {"impacts": impacts}).items()):
        strong = part.dropna(subset=["stress_max"]).nlargest(_MOST_POINTS, "stress_max")
        if len(strong):
            colour = COLOURS[k % len(COLOURS)]
            curves.append(Curve(label, strong[name].abs(), strong["stress_max"], colour, line=False, dots=True))
    unit = "each contact's own unit" if name in _BY_CONTACT and contacts else units[name]
    label = f"{words} [{unit}]"
    return Plot(f"Stress against {words}", label, "largest bending stress [Pa]", curves, from_zero=True)


# Charts of the bending stress that one impact leaves.

_HELD = (
    "The {body} was held in every impact: its speed did not jump, so that its {plural} do not ring. The push of the "
    "{striker} on the struck {name}'s root is not in this stress."
)


def stress_section(impacts: pd.DataFrame, struck: Struck, beam: Beam, card: MaterialCard, heading: str = "") -> str:
    """The stress that the impact leaves which leaves the largest; "" without an impact.

    Args:
        impacts: as of `stress.with_stress`.
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
    return section(heading, charts(*(chart(interactive(plot, height=300)) for plot in plots)), note=note)


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


# The damage that all impacts of a run do, as a section of its report.

#: The chart shows the stress after so many impacts at most.
_MOST_IMPACTS = 1000
#: Of that chart [px].
_HEIGHT = 260


def fatigue_section(
    impacts: pd.DataFrame,
    struck: Struck,
    beam: Beam,
    card: MaterialCard,
    damage: SequenceDamage,
    heading: str = "",
) -> str:
    """Numbers and the history of the stress, for a beam of the material of `card`; at least one impact."""
    heading = heading or f"Fatigue of the {struck.name}"
    numbers = table(list(HEADINGS), [damage_row(damage, card)], numeric=range(1, len(HEADINGS)))
    sources = f"{card.text}. {'; '.join(card.sources)}."
    history = chart(interactive(_history(impacts, struck, beam, card, damage.position), height=_HEIGHT))
    return section(heading, numbers, history, note=f"{damage_note(damage, struck, beam)} {sources}")


def _history(impacts: pd.DataFrame, struck: Struck, beam: Beam, card: MaterialCard, position: float) -> Plot:
    """Stress at the critical section over the run: a line from extreme to extreme."""
    time, stress = thin(*stress_history(impacts.head(_MOST_IMPACTS), struck, beam, card, position))
    left_out = f" (the first {_MOST_IMPACTS} impacts)" if len(impacts) > _MOST_IMPACTS else ""
    curve = Curve("bending stress", time, stress, COLOURS[0])
    title = f"Stress at the critical section{left_out}; zoom in to see a {struck.name} ring"
    return Plot(title, "time [s]", "bending stress [Pa]", [curve], legend=False)


# How far links give way in a run, as a section of its report.

_COMPLIANCE_NOTE = (
    "{Arm} and {strut} give way: with the drive standing still, the {wheel} stays behind by the lost motion. The "
    "effective {tooth} resolution is pitch and lost motion: by so much the drive must move the {wheel} to gain a "
    "{tooth}. The contact force acts slowly; the impact is that with the largest force, F = v sqrt(k m), with m from "
    "impulse and closing speed and k of the {strut} alone ({arm} and {tooth} would make it smaller); {arm} and lost "
    "motion are those of the smaller force of {strut} and {arm} in a chain, by the same energy. Both are bars of "
    "constant section{source}."
)


def compliance_section(chain: Chain | None, found: Sequence[Compliance]) -> str:
    """A column for each load; "" when the FMU declares no links, or nothing loads them."""
    if chain is None or not found:
        return ""
    columns = [compliance_values(chain, one) for one in found]
    rows = [
        [name.replace("_", " "), *(_compliance_cell(column[name], unit) for column in columns)]
        for name, unit in compliance_units(chain).items()
    ]
    headings = ["quantity", *(one.case for one in found)]
    words = {"arm": chain.arm.name, "strut": chain.strut.name, "wheel": chain.wheel.name, "tooth": chain.tooth}
    source = f" ({chain.source})" if chain.source else ""
    note = _COMPLIANCE_NOTE.format(**words, Arm=chain.arm.name.capitalize(), source=source)
    return section("Compliance", table(headings, rows, numeric=range(1, len(headings))), note=note)


def _compliance_cell(value: float, unit: str) -> str:
    return f"{value:.4g}" if unit == "1" else engineering(value, unit)
