"""Stress that an impact leaves in a tooth: beam modes, their response, and the bending stress they make.

A `WedgeTooth` of a `Material` has `ritz_modes`; struck, it swings by `damped_response` with `bending_moment` and
`bending_stress`, of which `maximum_stress` is the largest over length and time. Any other `Beam`, held in any usual
way, has `natural_modes`. What a whole sequence of impacts does, while the tooth still rings from those before, say
`Ringing` and `sequence_damage`, with a `material_card` and `converged_modes`. `beam_theory_note` says whether the tooth
is slender enough for all this.
"""

from .beam import Beam
from .cards import CARDS, STEEL_CARD, MaterialCard, material_card
from .converged import converged_modes
from .ends import End
from .exact_wedge import exact_wedge_frequencies
from .fatigue import Cycle, MeanStress, Strength, miner_damage, rainflow_cycles
from .general_beam import SectionBeam, TableBeam
from .material import STEEL, Material
from .maximum import MaximumStress, maximum_stress
from .modes import BeamMode, ritz_modes
from .natural_mode import Mode, NaturalMode
from .recovery import bending_moment, bending_stress
from .response import damped_response
from .ringing import Ringing, Swing
from .ritz import natural_modes
from .scaling import ModeScaling
from .sequence import SequenceDamage, sequence_damage
from .shear import shear_force, shear_stress
from .slenderness import LEAST_SLENDERNESS, beam_theory_note, slenderness
from .tip import LineContact, axial_stress, hertz_line_contact, peak_force, shortest_contact
from .tooth import RectangularTooth, TrapezoidTooth, WedgeTooth, wedge_of_sawtooth

__all__ = [
    "CARDS",
    "LEAST_SLENDERNESS",
    "STEEL",
    "STEEL_CARD",
    "Beam",
    "BeamMode",
    "Cycle",
    "End",
    "LineContact",
    "Material",
    "MaterialCard",
    "MaximumStress",
    "MeanStress",
    "Mode",
    "ModeScaling",
    "NaturalMode",
    "RectangularTooth",
    "Ringing",
    "SectionBeam",
    "SequenceDamage",
    "Strength",
    "Swing",
    "TableBeam",
    "TrapezoidTooth",
    "WedgeTooth",
    "axial_stress",
    "beam_theory_note",
    "bending_moment",
    "bending_stress",
    "converged_modes",
    "damped_response",
    "exact_wedge_frequencies",
    "hertz_line_contact",
    "material_card",
    "maximum_stress",
    "miner_damage",
    "natural_modes",
    "peak_force",
    "rainflow_cycles",
    "ritz_modes",
    "sequence_damage",
    "shear_force",
    "shear_stress",
    "shortest_contact",
    "slenderness",
    "wedge_of_sawtooth",
]
