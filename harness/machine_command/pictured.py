"""Which variables of a machine its pictures need."""

from __future__ import annotations

from collections.abc import Mapping

from ..description import Description
from ..drawing import Drawing
from ..report.modes import SUFFIX
from ..report.scene import names_of


def pictured(drawings: Mapping[str, Drawing], descriptions: Mapping[str, Description]) -> tuple[list[str], list[str]]:
    """Those that move, active contacts and strokes among them, and those that do not, by their names in the machine."""
    moving, constant = [], []
    for part, drawing in drawings.items():
        drawn = names_of(drawing.shapes)
        struck = descriptions[part].analysis.struck
        counter = "" if struck is None else struck.strokes
        for name, variable in descriptions[part].variables.items():
            if variable.causality not in ("input", "output"):
                constant += [f"{part}.{name}"] if name in drawn else []
            elif (
                name in drawn
                or _told_of_contacts(drawing, name, variable.type)
                or _counts(counter, name, variable.type)
            ):
                moving.append(f"{part}.{name}")
    return moving, constant


def _told_of_contacts(drawing: Drawing, name: str, kind: str) -> bool:
    return bool(drawing.shapes) and kind == "Boolean" and name.endswith(SUFFIX)


def _counts(counter: str, name: str, kind: str) -> bool:
    return name == counter and kind in ("Integer", "Real")
