"""What came of a machine's run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from mechanism_fmu.stress import MaterialCard

from ..drawing import Drawing
from ..master import Outcome
from ..messages import LogMessage
from .bonds import BondEnergy
from .frames import Seen
from .impacts import ComponentImpacts
from .prepared import Prepared


@dataclass(frozen=True)
class MachineRun:
    """What came of a run.

    Attributes:
        machine: that ran.
        outcome: how far it came.
        results: file of the recorded signals; of a run whose disk was full, the folder of what was recorded before.
        units: of results and of impacts, by name ("1": dimensionless).
        impacts: of all components, in the order of time.
        by_component: what struck each component that reports impacts.
        card: material of the beams that impacts strike.
        bonds: energies over power bonds, by name.
        statistics: of each component, ready for JSON.
        rows: of their table, below `machine.statistics.HEADINGS`.
        wall_time: of the simulation [s].
        messages: that need attention, of the components' FMUs; the first ones, if there are very many.
        drawings: of the components' mechanisms, by name.
        seen: what pictures of it need.
        cautions: what the user should know before believing it, beside the machine's notes.
    """

    machine: Prepared
    outcome: Outcome
    results: Path
    units: Mapping[str, Mapping[str, str]]
    impacts: pd.DataFrame
    by_component: Mapping[str, ComponentImpacts]
    card: MaterialCard
    bonds: Mapping[str, BondEnergy]
    statistics: Mapping[str, Mapping[str, float]]
    rows: list[list[str]]
    wall_time: float
    messages: Sequence[LogMessage]
    drawings: Mapping[str, Drawing]
    seen: Seen
    cautions: list[LogMessage]
