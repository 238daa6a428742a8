"""The rattling pawl as a model: one FMU that does nothing but impacts."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

from mechanism_fmu.model import Mechanism, Model, Output

from .impacts import pawl

#: The FMU's impact counter.
COUNTER = "impact_count"


def _mechanism(_values: SimpleNamespace) -> Mechanism:
    return replace(
        pawl(),
        outputs=(
            Output(COUNTER, "impact.count", "Impacts since the start", type="Integer"),
            Output("kinetic_energy", "energy.kinetic", "Kinetic energy", "J"),
            Output("spring_energy", "energy.spring", "Energy of the spring", "J"),
            Output("work_done", "energy.work", "Work done from outside", "J"),
        ),
    )


MODEL = Model("Rattling", "A light pawl that rattles on its stop and never comes to rest", (), _mechanism)
