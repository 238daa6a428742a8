"""The mechanism in motion: an animation that plays in the report, from the recorded outputs alone."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..experiment import Run
from .modes import contacts
from .page import section
from .player import MOST_IMPACTS, flags, legend, picture_data, player, rounded, times_data
from .scene import Scene, names_of
from .style import IMPACT_COLOUR
from .thin import frame_rows, strongest

#: Of the section.
HEADING = "Mechanism"

#: A smooth motion needs no more frames, and the report stays small; each impact takes two of them.
_MOST_FRAMES = 2000


def animation(run: Run, heading: str = HEADING, about: str = "") -> str:
    """The section with the animation; "" when the FMU has no drawing, or the run never began.

    `about` is what else there is to say.
    """
    if run.drawing.objection:
        return section(heading, note=run.drawing.objection)
    if not run.drawing.shapes or run.results.empty or not run.parameters:
        return ""
    data = animation_data(run)
    if data is None:
        return section(heading, note="The motion is not finite, or has no extent: there is nothing to draw.")
    note = f"{about} Drawn from the recorded angles and the FMU's parameters.".strip()
    if len(run.impacts) > MOST_IMPACTS:
        note += f" Of {len(run.impacts)} impacts the {MOST_IMPACTS} strongest flash."
    picture = '<svg role="img" aria-label="The mechanism at the time shown below"></svg>'
    return section(heading, player(data, picture + legend(data["shapes"], contacts(run))), note=note)


def animation_data(run: Run) -> dict[str, Any] | None:
    """What the player needs (`player.player`), as JSON; None when there is nothing to draw."""
    names = sorted(names_of(run.drawing.shapes))
    moving = [name for name in names if name in run.results]
    table = run.results[["time", *moving]].to_numpy(dtype=np.float64)
    usable = np.isfinite(table).all(axis=1)
    if not usable.any():
        return None
    table, results = table[usable], run.results[usable]
    impacts = strongest(run.impacts, MOST_IMPACTS)
    impacts = impacts[np.isfinite(impacts)]
    rows = frame_rows(table[:, 0], impacts, _MOST_FRAMES)
    frames = table[rows]
    columns = dict(zip(moving, frames.T[1:], strict=True))
    constants = {name: float(run.parameters[name]) for name in names if name not in columns}
    angles = {name for name in moving if run.description.variable(name).unit == "rad"}
    picture = picture_data(Scene(run.drawing.shapes, columns, constants), angles)
    if picture is None:
        return None
    active = [
        {"name": contact.name, "colour": contact.colour, "active": flags(results[contact.variable].iloc[rows])}
        for contact in contacts(run)
    ]
    clock = times_data(frames[:, 0])
    return clock | picture | {"impacts": rounded(impacts, 9), "contacts": active, "flash": IMPACT_COLOUR}
