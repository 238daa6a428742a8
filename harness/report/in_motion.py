"""The section of a sweep's or an optimum's report that shows one design in motion."""

from __future__ import annotations

from ..designs.in_motion import InMotion
from .animation import HEADING, animation
from .page import section


def animation_of_design(seen: InMotion | None) -> str:
    """The section, with the reason when nothing can be seen; "" when the FMU has no drawing."""
    if seen is None:
        return ""
    drawn = "" if seen.run is None else animation(seen.run, about=seen.told)
    return drawn or section(HEADING, note=seen.told)
