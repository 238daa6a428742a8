"""A machine whose file is read, and whose FMUs are there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..description import Description
from ..fmu import Fmu
from ..inputs import InputSignals
from .file.notes import notes
from .file.plan import Plan


@dataclass(frozen=True)
class Prepared:
    """A machine whose FMUs are there.

    Attributes:
        plan: it.
        fmus: of its components, by name.
        description: of it, connected.
        inputs: that a table drives.
    """

    plan: Plan
    fmus: Mapping[str, Fmu]
    description: Description
    inputs: InputSignals | None

    @property
    def descriptions(self) -> dict[str, Description]:
        """Of the components' FMUs, by name."""
        return {name: fmu.description for name, fmu in self.fmus.items()}

    @property
    def notes(self) -> list[str]:
        """What is to be said of it that is no mistake."""
        driven = [] if self.inputs is None else [variable.name for variable in self.inputs.variables]
        read = [] if self.inputs is None or not self.inputs.note else [self.inputs.note]
        return read + notes(self.plan, self.descriptions, driven)
