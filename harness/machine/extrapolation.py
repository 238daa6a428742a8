"""How inputs go on between communication points."""

from __future__ import annotations

from enum import StrEnum

from .signals import Signals


class Extrapolation(StrEnum):
    """What is known of an output decides what the inputs that follow it do during the next step."""

    #: They are held: an error of first order in the step.
    CONSTANT = "constant"
    #: They go on as from the communication point before: of second order; held for a step after an impact.
    LINEAR = "linear"
    #: They go on with the output's derivative, and with the mean of how that changes: of third order. What has no
    #: derivative is held in the first step and in the one after an impact, which leaves an error of second order.
    DERIVATIVES = "derivatives"

    def slopes(self, signals: Signals) -> list[float]:
        """Slopes of outputs in the next step [unit/s]."""
        if self is Extrapolation.CONSTANT:
            return [0.0] * len(signals.names)
        return signals.differences() if self is Extrapolation.LINEAR else signals.derivatives()

    @property
    def order(self) -> int:
        """Of the error that a step leaves behind in the long run."""
        return 1 if self is Extrapolation.CONSTANT else 2
