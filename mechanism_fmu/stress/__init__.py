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
from .shear import shear_force, shear_stress
from .tip import LineContact, axial_stress, hertz_line_contact, peak_force, shortest_contact
from .tooth import RectangularTooth, TrapezoidTooth, WedgeTooth, wedge_of_sawtooth

__all__ = [
    "STEEL",
    "Beam",
    "BeamMode",
    "End",
    "LineContact",
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
    "axial_stress",
    "bending_moment",
    "bending_stress",
    "damped_response",
    "exact_wedge_frequencies",
    "hertz_line_contact",
    "maximum_stress",
    "natural_modes",
    "peak_force",
    "ritz_modes",
    "shear_force",
    "shear_stress",
    "shortest_contact",
    "wedge_of_sawtooth",
]
