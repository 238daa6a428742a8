"""What swings and is timed: an element without a force."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..attached import Slot
from ..body import GROUND
from ..functions import Number
from .base import Element, Quantity


@dataclass(frozen=True, init=False)
class Oscillation(Element):
    """The swing of a body that turns to and fro, as of a pendulum or balance, timed as a watchmaker does.

    A period lasts from one passage of the middle, upwards (the angle grows), to the next. Its power is the work done on
    the mechanism meanwhile, by a weight or mainspring, over its length. The amplitude is half the way from the lowest
    to the highest angle, each the extreme of the last half swing that is complete. All are 0 until they are known. The
    motion is the same, to the bit, as without.

    Attributes:
        name: unique within the mechanism.
        body: name of the body.
        middle: angle of the body about which it swings [rad].
        nominal_period: that of a clock that keeps time [s], > 0: the rate is how much it gains on that a day.

    Source: definition: rate = 86400 (nominal_period / period - 1) [s/d]; period, amplitude and rate as in horology.
    """

    row: ClassVar = "oscillation"
    quantities: ClassVar = {
        "period": Quantity("s", "Last whole period"),
        "amplitude": Quantity("rad", "Half the angle from extreme to extreme"),
        "rate": Quantity("s/d", "Gain on the nominal period, over the last one"),
        "power": Quantity("W", "Mean power done on the mechanism over the last period"),
        "passages": Quantity("1", "Passages of the middle, upwards"),
        "last_passage": Quantity("s", "Time of the last of them; -1 before the first"),
    }
    acts: ClassVar = "nowhere"
    reaction: ClassVar[str] = GROUND
    slots: ClassVar = (Slot("body"),)
    positive: ClassVar = {"nominal_period": "s"}
    units: ClassVar = {**positive, "middle": "rad"}

    name: str
    body: str
    middle: Number = 0.0
    nominal_period: Number = 1.0
