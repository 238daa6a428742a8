"""What a tool is asked for: some equal steps of one FMU, and outputs at their end."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from fmpy import read_model_description

from tests.importers.forms import Form

#: What these say is of the last communication step alone, and event mode makes it shorter.
_OF_THE_STEP = {"impact", "impacts_in_step", "impacts_lost", "events_in_step"}
_KINDS = {
    "Real": "real",
    "Float64": "real",
    "Integer": "integer",
    "Int32": "integer",
    "Boolean": "boolean",
}


@dataclass(frozen=True)
class Output:
    """An output: its kind is "real", "integer" or "boolean"."""

    name: str
    kind: str
    reference: int


@dataclass(frozen=True)
class Asked:
    """A run.

    Attributes:
        fmu: path of the file.
        model: its name.
        fmi: major version of the standard.
        step: communication step size [s].
        steps: how many.
        outputs: that are wanted at the end.
        event_mode: use event mode and early return.
        exchange: integrate it, as Model Exchange.
        needs_python: the FMU runs in the host's Python.
        folder: for files, empty.
    """

    fmu: str
    model: str
    fmi: int
    step: float
    steps: int
    outputs: tuple[Output, ...]
    event_mode: bool
    exchange: bool
    needs_python: bool
    folder: str

    @property
    def stop(self) -> float:
        """End of the run [s]."""
        return self.step * self.steps

    def names(self) -> list[str]:
        """Of the outputs."""
        return [output.name for output in self.outputs]

    def of_kind(self, kind: str) -> list[Output]:
        """Outputs of a kind."""
        return [output for output in self.outputs if output.kind == kind]

    def to_json(self) -> str:
        """For another process."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> Asked:
        """From another process."""
        found = json.loads(text)
        return cls(**found | {"outputs": tuple(Output(**output) for output in found["outputs"])})


def asked(fmu: Path, folder: Path, form: Form | None = None, until: float = math.inf, most_steps: int = 200) -> Asked:
    """The default experiment of an FMU, or its beginning, with all outputs that do not speak of the last step alone.

    Args:
        fmu: the file.
        folder: for files, empty.
        form: in which it is run; the simplest one.
        until: end of what two integrators of different tolerances can be compared over [s]; with it, without outputs
            that count hops which either may sum up.
        most_steps: so many steps at most.
    """
    description = read_model_description(str(fmu))
    experiment = description.defaultExperiment
    step = float(experiment.stepSize)
    steps = min(most_steps, round(min(until, float(experiment.stopTime)) / step))
    compared = (v for v in description.modelVariables if _lasts(v) and (until == math.inf or _is_integrated(v.name)))
    return Asked(
        str(fmu),
        description.coSimulation.modelIdentifier,
        int(description.fmiVersion[0]),
        step,
        steps,
        tuple(Output(v.name, _KINDS[v.type], v.valueReference) for v in compared),
        form is not None and form.event_mode,
        form is not None and form.exchange,
        bool(description.coSimulation.needsExecutionTool),
        str(folder),
    )


def _is_integrated(name: str) -> bool:
    return name.endswith(("_angle", "_speed", "energy_lost")) and not name.startswith("impact")


def _lasts(variable: Any) -> bool:
    output = variable.causality == "output" and variable.type in _KINDS
    plain = not (variable.clocks or variable.dimensions or "[" in variable.name)
    return output and plain and variable.name not in _OF_THE_STEP
