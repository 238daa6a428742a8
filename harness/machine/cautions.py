"""What the user of a machine should know before believing its results."""

from __future__ import annotations

from collections.abc import Mapping

from ..messages import LogMessage, Status
from .algorithms.adaptive import LEAST_STEP, Adaptive
from .algorithms.base import Algorithm
from .algorithms.event_aware import EventAware
from .bonds import BondEnergy
from .machine import Machine

#: A coupling that makes or loses more than this fraction of what passes is told of.
_TOLERATED = 0.05


def cautions(algorithm: Algorithm) -> list[LogMessage]:
    """Warnings for `terminal.show_warning` and summary.json.

    Those of parts that cannot be put back are known before the run, those of steps that were too long after it.
    """
    if isinstance(algorithm, EventAware):
        return [
            _warning(
                name,
                "it cannot be put back (canGetAndSetFMUstate), so the others feel its impacts only at the end of the "
                "step; take a shorter step to feel them sooner.",
            )
            for name in algorithm.felt_late
        ]
    if isinstance(algorithm, Adaptive) and algorithm.too_small:
        return [
            _warning(
                "machine",
                f"{algorithm.too_small} steps missed the tolerance {algorithm.tolerance:g} though they were as short "
                f'as they may be, {LEAST_STEP / 1000:g} us; impacts are for algorithm = "event_aware".',
            )
        ]
    return []


def loop_cautions(machine: Machine, time: float) -> list[LogMessage]:
    """A warning of loops without delay that a run until `time` [s] has left unsolved."""
    if not machine.unsettled:
        return []
    inputs = "; ".join(", ".join(loop) for loop in machine.structure.loops)
    return [
        _warning(
            "machine",
            f"{machine.unsettled} exchanges ended while a loop without any delay was still changing its inputs "
            f"({inputs}): they, and all that follows them, depend on how often it was gone round. Let one of its "
            "components tell something that does not follow its inputs at once, such as the motion of an inertia.",
            time,
        )
    ]


def bond_cautions(energies: Mapping[str, BondEnergy], time: float) -> list[LogMessage]:
    """Warnings of couplings that have made or lost much energy until `time` [s]: the steps are too long for them."""
    told = []
    for name, energy in energies.items():
        if abs(energy.made) > _TOLERATED * energy.most:
            did = "made" if energy.made > 0.0 else "lost"
            told.append(
                _warning(
                    "machine",
                    f"over the bond '{name}', the coupling itself has {did} {abs(energy.made):.3g} J, where "
                    f"{energy.most:.3g} J passed at most: the motion is that of another machine, or unstable. Take "
                    'extrapolation = "derivatives" and a step that the lightest body on this shaft allows '
                    '(docs/machines-running.md), or algorithm = "adaptive".',
                    time,
                )
            )
    return told


def _warning(instance: str, text: str, time: float = 0.0) -> LogMessage:
    return LogMessage(instance, time, Status.WARNING, "", text)
