"""The drawing that travels in an FMU, for tools that show the motion: `resources/drawing.json`."""

from __future__ import annotations

import json
from dataclasses import asdict

from ..model import Model
from ..model.drawing import check_drawing
from .variables import variables_of

#: Path within the FMU.
DRAWING = "resources/drawing.json"

#: Grows when readers of the old format would misunderstand the new one.
FORMAT = 1


def drawing(model: Model) -> dict[str, bytes]:
    """The file by its path within the FMU: the same bytes for the same drawing; none when the model has no drawing.

    `{"format": 1, "shapes": [{"kind": "bar", ...}, ...]}`, the other keys as in `mechanism_fmu.model.drawing`.

    Raises:
        MechanismError: the drawing names what the FMU does not have; see `check_drawing`.
    """
    if not model.drawing:
        return {}
    # Inputs are left out: an FMU need not give back what was set. Buffered impacts are no state of the mechanism.
    known = {v.name for v in variables_of(model) if v.causality != "input" and "[" not in v.name}
    check_drawing(model.drawing, known)
    shapes = [{"kind": type(shape).__name__.lower(), **asdict(shape)} for shape in model.drawing]
    text = json.dumps({"format": FORMAT, "shapes": shapes}, separators=(",", ":"), allow_nan=False)
    return {DRAWING: f"{text}\n".encode()}
