"""The section of a sweep's or an optimum's report that shows one design in motion."""

from __future__ import annotations

from mechanism_fmu.stress import beam_theory_note

from ..designs.in_motion import InMotion
from .animation import HEADING, animation
from .page import section


def animation_of_design(seen: InMotion | None) -> str:
    """The section, with the reason when nothing can be seen; "" when the FMU has no drawing."""
    if seen is None:
        return ""
    told = seen.told
    if seen.run is not None and seen.run.beam is not None:
        struck = seen.run.description.analysis.struck
        told += f" Its {struck.name if struck else 'beam'}: {beam_theory_note(seen.run.beam)}"
    drawn = "" if seen.run is None else animation(seen.run, about=told)
    return drawn or section(HEADING, note=told)
