"""Forces and torques of joints as outputs: which multiplier each is, and times what.

A multiplier lambda acts as M qdd = F + Phi_q^T lambda.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from .. import codes
from .conditions import length
from .functions import Number
from .joints import Joint


def _same(_: Any) -> Number:
    return 1.0


def _opposite(_: Any) -> Number:
    return -1.0


#: By kind of joint and name of the output: the row of the joint, and the factor of its multiplier.
EFFORTS: Mapping[int, Mapping[str, tuple[int, Callable[[Any], Number]]]] = {
    codes.REVOLUTE: {"force_x": (0, _same), "force_y": (1, _same)},
    codes.TRANSLATIONAL: {"force": (0, lambda joint: length(joint.axis_i))},
    codes.DISTANCE: {"force": (0, lambda joint: -2 * joint.distance)},
    codes.REVOLUTE_TRANSLATIONAL: {"force": (0, _same)},
    codes.GEARS: {"force": (0, _opposite)},
    codes.INTERNAL_GEARS: {"force": (0, _opposite)},
    codes.RACK: {"force": (1, _same), "normal_force": (0, _same)},
    codes.X_DRIVER: {"force": (0, _same)},
    codes.Y_DRIVER: {"force": (0, _same)},
    codes.ANGLE_DRIVER: {"torque": (0, _same)},
    codes.TRANSLATIONAL_DRIVER: {"force": (0, _same)},
}


def effort(joint: Joint, quantity: str) -> tuple[int, Number] | None:
    """The row (within the joint) and the factor of an effort; None when the joint has no such output.

    Revolute: force on `body_i`. Translational, RevoluteTranslational: force on `body_j` along R axis_i. Distance:
    tension. Gears: tangential force F, with the torque F radius_i on `body_i`. Rack and pinion: force on the pinion
    along the rack, and away from it. Drivers: what they exert on `body_j`.
    """
    found = EFFORTS.get(joint.kind, {}).get(quantity)
    return None if found is None else (found[0], found[1](joint))
