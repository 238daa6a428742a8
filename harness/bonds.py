"""The energy that a coupling makes or loses: what one part gives is not just what the other takes.

A bond is two connections: a flow (a speed) one way, and an effort (a torque, a force) the other way. Each part sees the
other's quantity as it was at the beginning of the step, so that the two reckon with different powers (Sadjina,
Kyllingstad, Skjong, Pedersen: Energy conservation and power bonds in co-simulations, 2017).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from .coupling import Connection


@dataclass(frozen=True)
class Bond:
    """A power bond; all quantities in SI units.

    Attributes:
        flow: from the driving part to the driven one.
        effort: back, with the sign that it has on the driving part.
    """

    flow: Connection
    effort: Connection


@dataclass(frozen=True)
class BondEnergy:
    """Energies over a run [J].

    Attributes:
        given: by the driving part.
        taken: by the driven part.
        most: largest size of the energy that had passed at any time: what to compare `made` with.
    """

    given: float
    taken: float
    most: float

    @property
    def made(self) -> float:
        """What the coupling has added."""
        return self.taken - self.given


def bond_energy(results: pd.DataFrame, bond: Bond) -> BondEnergy:
    """Energy over a bond, from what a `Recorder` kept of a coupling.

    During a step each part has its input from the step's beginning, while the other's quantity itself goes on; its mean
    is taken as that of beginning and end.
    """

    def column(name: str) -> npt.NDArray[np.float64]:
        return results[name].to_numpy(dtype=np.float64)[1:]

    def mean(connection: Connection) -> npt.NDArray[np.float64]:
        begin = (column(connection.target) - connection.offset) / connection.gain
        return (begin + column(connection.source)) / 2

    step = np.diff(results["time"].to_numpy(dtype=np.float64))
    given = np.cumsum(-step * column(bond.effort.target) * mean(bond.flow))
    taken = np.cumsum(step * mean(bond.effort) * column(bond.flow.target))
    return BondEnergy(float(given[-1]), float(taken[-1]), float(np.abs(given).max()))
