"""The forms in which a model becomes an FMU, and in which an importer may run it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import models
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.fmu.parts.variables import variables_of

#: With outlines, so far are models integrated as Model Exchange [s].
_INTEGRATED = {"geneva_clearance": 1.0, "lever_escapement": 0.5, "pin_pallet": 0.5, "verge": 0.6, "graham": 1.0}


@dataclass(frozen=True)
class Form:
    """A form.

    Attributes:
        key: short name.
        title: head of a column.
        fmi: major version of the standard.
        build: makes the file.
        options: of `build`.
        event_mode: run with event mode and early return.
        exchange: as Model Exchange, integrated by the importer.
    """

    key: str
    title: str
    fmi: int
    build: Callable[..., Path]
    options: Mapping[str, int] = field(default_factory=dict)
    event_mode: bool = False
    exchange: bool = False

    def fits(self, name: str) -> bool:
        """Whether there is a ready-made model in this form: what has no impacts has no clock."""
        model = models.load(name).MODEL
        return not self.options.get("clocks") or any(v.source == "impact.any" for v in variables_of(model))

    def until(self, name: str) -> float:
        """End of what is compared [s]: an importer's integrator has its own tolerance, and outlines take many looks."""
        return _INTEGRATED.get(name, 2.0) if self.exchange else math.inf

    @property
    def file(self) -> tuple[str, tuple[tuple[str, int], ...]]:
        """What two forms that are the same file have in common."""
        return self.build.__name__, tuple(sorted(self.options.items()))


FORMS = {
    form.key: form
    for form in (
        Form("fmi2", "FMI 2.0", 2, build_native_fmu),
        Form("fmi3", "FMI 3.0", 3, build_native_fmu, {"fmi": 3}),
        Form("fmi3_events", "FMI 3.0, event mode", 3, build_native_fmu, {"fmi": 3}, event_mode=True),
        Form(
            "clocks", "FMI 3.0 `--clocks`, event mode", 3, build_native_fmu, {"fmi": 3, "clocks": True}, event_mode=True
        ),
        Form("pythonfmu", "pythonfmu", 2, build_fmu),
        Form("exchange2", "Model Exchange, FMI 2.0", 2, build_native_fmu, exchange=True),
        Form("exchange3", "Model Exchange, FMI 3.0", 3, build_native_fmu, {"fmi": 3}, exchange=True),
    )
}
