"""Stress that an impact leaves in a tooth: beam modes, their response, and the bending stress they make.

A `WedgeTooth` of a `Material` has `ritz_modes`; struck, it swings by `damped_response` with `bending_moment` and
`bending_stress`, of which `maximum_stress` is the largest over length and time. Any other `Beam`, held in any usual
way, has `natural_modes`.
"""

from .beam import Beam
from .ends import End
from .exact_wedge import exact_wedge_frequencies
from .general_beam import SectionBeam, TableBeam
from .material import STEEL, Material
from .maximum import MaximumStress, maximum_stress
from .modes import BeamMode, ritz_modes
from .natural_mode import Mode, NaturalMode
from .recovery import bending_moment, bending_stress
from .response import damped_response
from .ritz import natural_modes
from .scaling import ModeScaling
from .tooth import RectangularTooth, TrapezoidTooth, WedgeTooth, wedge_of_sawtooth

__all__ = [
    "STEEL",
    "Beam",
    "BeamMode",
    "End",
    "Material",
    "MaximumStress",
    "Mode",
    "ModeScaling",
    "NaturalMode",
    "RectangularTooth",
    "SectionBeam",
    "TableBeam",
    "TrapezoidTooth",
    "WedgeTooth",
    "bending_moment",
    "bending_stress",
    "damped_response",
    "exact_wedge_frequencies",
    "maximum_stress",
    "natural_modes",
    "ritz_modes",
    "wedge_of_sawtooth",
]
