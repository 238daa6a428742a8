"""What the ratchet declares to be analysed, for units that pretend to be one."""

from __future__ import annotations

import io
import zipfile

import models
from harness.fmu.declared import FILE, Declared, Struck, read_declared
from mechanism_fmu.fmu.parts.resources import analysis
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import Model


def declared_of(model: Model) -> Declared:
    """What the harness reads of a model's FMU."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in analysis(model).items():
            archive.writestr(name, data)
    return read_declared(file, {variable.name: variable for variable in variables_of(model)})  # type: ignore[arg-type]


def struck_of(declared: Declared) -> Struck:
    assert declared.struck is not None, f"{FILE} declares nothing to strike"
    return declared.struck


RATCHET = declared_of(models.load("ratchet").MODEL)
STRUCK = struck_of(RATCHET)
#: The teeth alone.
TEETH = Declared(struck=STRUCK)
