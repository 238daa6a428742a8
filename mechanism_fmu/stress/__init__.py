"""Stress that an impact leaves in a tooth: beam modes, their response, and the bending stress they make.

A `WedgeTooth` of a `Material` has `ritz_modes`; struck, it swings by `damped_response` with `bending_moment` and
`bending_stress`, of which `maximum_stress` is the largest over length and time.
"""

from .material import STEEL, Material
from .maximum import MaximumStress, maximum_stress
from .modes import BeamMode, ritz_modes
from .recovery import bending_moment, bending_stress
from .response import damped_response
from .tooth import WedgeTooth

__all__ = [
    "STEEL",
    "BeamMode",
    "Material",
    "MaximumStress",
    "WedgeTooth",
    "bending_moment",
    "bending_stress",
    "damped_response",
    "maximum_stress",
    "ritz_modes",
]
