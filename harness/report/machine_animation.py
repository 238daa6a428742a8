"""A whole machine in motion: the pictures of its components beside each other, with one player for all."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np
import pandas as pd

from ..machine.names import own_of, part_of
from ..machine.order import dependency_order
from ..machine.performed import MachineRun
from .modes import Contact, contacts_among
from .page import section
from .player import MOST_IMPACTS, flags, legend, picture_data, player, rounded, times_data
from .scene import Scene, names_of
from .style import IMPACT_COLOUR
from .thin import FloatArray, strongest

HEADING = "The machine in motion"

#: Of one picture, before it is scaled to the screen [px].
_SIZE = [300, 230]


def in_power_flow(run: MachineRun) -> list[str]:
    """The components in the order in which power passes over bonds; where none says so, as they take their steps."""
    bonds = run.machine.plan.bonds
    pairs = [(part_of(bond.flow.source), part_of(bond.flow.target)) for bond in bonds]
    return dependency_order(list(run.statistics), pairs)[0]


def machine_animation(run: MachineRun) -> str:
    """The section; one that says why there is nothing to see, if so."""
    data, figures = _pictures(run)
    if data is None:
        note = "None of the components has a picture: their FMUs bring no resources/drawing.json that can be shown."
        return section(HEADING, note=note)
    note = (
        f"Each component at a scale of its own, from the side where power comes in; {len(data['time'])} moments of the "
        "run, between which angles and lengths go on evenly."
    )
    shown = len(data["impacts"])
    if shown < len(run.impacts):
        note += f" Of {len(run.impacts)} impacts the {shown} strongest of each component flash."
    return section(HEADING, player(data, f'<div class="panels">{"".join(figures)}</div>'), note=note)


def _pictures(run: MachineRun) -> tuple[dict[str, Any] | None, list[str]]:
    """What the player needs, None when there is no picture; and a figure for each component."""
    table = run.seen.table
    panels, lamps, figures = [], [], []
    for number, name in enumerate(in_power_flow(run), start=1):
        caption = f"<figcaption>{number} {escape(name)}</figcaption>"
        picture = None if table.empty else _picture(run, name, table)
        if picture is None:
            drawing = run.drawings[name]
            reason = drawing.objection or ("There is nothing to draw." if drawing.shapes else "Its FMU has no picture.")
            figures.append(f'<figure><div class="blank">{escape(reason)}</div>{caption}</figure>')
            continue
        told = _contacts(run, name, table)
        lamps += [_lamp(contact, table) for contact in told]
        panels.append(picture | {"size": _SIZE, "impacts": rounded(_struck(run, name), 9)})
        label = f"{name} at the time shown below"
        figures.append(
            f'<figure><svg role="img" aria-label="{escape(label)}"></svg>{caption}'
            f"{legend(picture['shapes'], [_own(contact) for contact in told])}</figure>"
        )
    if not panels:
        return None, figures
    times, whose = _all_impacts(run)
    clock = times_data(table["time"].to_numpy())
    shared = {"impacts": times, "whose": whose, "contacts": lamps, "flash": IMPACT_COLOUR}
    return clock | shared | {"panels": panels}, figures


def _picture(run: MachineRun, name: str, table: pd.DataFrame) -> dict[str, Any] | None:
    """Of one component; None when it has none."""
    shapes = run.drawings[name].shapes
    if not shapes:
        return None
    columns, constants = {}, {}
    for own in sorted(names_of(shapes)):
        whole = f"{name}.{own}"
        if whole in table:
            columns[own] = table[whole].to_numpy()
        else:
            constants[own] = float(run.seen.constants[whole])
    variables = run.machine.fmus[name].description.variables
    return picture_data(Scene(shapes, columns, constants), {own for own in columns if variables[own].unit == "rad"})


def _contacts(run: MachineRun, name: str, table: pd.DataFrame) -> list[Contact]:
    """Those of a component, by the names that their variables have in the machine."""
    outputs = [v for v in run.machine.description.of("output") if v.name in table and part_of(v.name) == name]
    return contacts_among(outputs)


def _own(contact: Contact) -> Contact:
    return Contact(own_of(contact.name), contact.variable, contact.colour)


def _lamp(contact: Contact, table: pd.DataFrame) -> dict[str, Any]:
    return {"name": contact.name, "colour": contact.colour, "active": flags(table[contact.variable])}


def _struck(run: MachineRun, name: str) -> FloatArray:
    """Times of the impacts of a component that are shown [s]."""
    struck = run.by_component.get(name)
    if struck is None or "time" not in struck.impacts:
        return np.empty(0)
    times = strongest(struck.impacts, MOST_IMPACTS)
    return times[np.isfinite(times)]


def _all_impacts(run: MachineRun) -> tuple[list[float], Sequence[str]]:
    """Times of all impacts that are shown, in their order, and which component each is of."""
    pairs = sorted((time, name) for name in run.by_component for time in rounded(_struck(run, name), 9))
    return [time for time, _ in pairs], [name for _, name in pairs]
