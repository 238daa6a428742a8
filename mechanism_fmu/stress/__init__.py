"""Stress that an impact leaves in a tooth: beam modes, their response, and the bending stress they make.

A `WedgeTooth` of a `Material` has `ritz_modes`; struck, it swings by `damped_response` with `bending_moment` and
`bending_stress`, of which `maximum_stress` is the largest over length and time. Any other `Beam`, held in any usual
way, has `natural_modes`. What a whole sequence of impacts does, while the tooth still rings from those before, say
`Ringing` and `sequence_damage`, with a `material_card` and `converged_modes`. `beam_theory_note` says whether the tooth
is slender enough for all this.
"""

from .beam import (
    LEAST_SLENDERNESS as LEAST_SLENDERNESS,
    Beam as Beam,
    beam_theory_note as beam_theory_note,
    slenderness as slenderness,
)
from .fatigue import (
    Cycle as Cycle,
    MeanStress as MeanStress,
    Strength as Strength,
    miner_damage as miner_damage,
    rainflow_cycles as rainflow_cycles,
)
from .material import (
    CARDS as CARDS,
    STEEL as STEEL,
    STEEL_CARD as STEEL_CARD,
    Material as Material,
    MaterialCard as MaterialCard,
    material_card as material_card,
)
from .maximum import MaximumStress as MaximumStress, maximum_stress as maximum_stress
from .modes import (
    BeamMode as BeamMode,
    converged_modes as converged_modes,
    exact_wedge_frequencies as exact_wedge_frequencies,
    ritz_modes as ritz_modes,
)
from .recovery import (
    bending_moment as bending_moment,
    bending_stress as bending_stress,
    damped_response as damped_response,
    shear_force as shear_force,
    shear_stress as shear_stress,
)
from .ringing import (
    Ringing as Ringing,
    SequenceDamage as SequenceDamage,
    Swing as Swing,
    sequence_damage as sequence_damage,
)
from .ritz import (
    End as End,
    Mode as Mode,
    ModeScaling as ModeScaling,
    NaturalMode as NaturalMode,
    natural_modes as natural_modes,
)
from .tip import (
    LineContact as LineContact,
    axial_stress as axial_stress,
    hertz_line_contact as hertz_line_contact,
    peak_force as peak_force,
    shortest_contact as shortest_contact,
)
from .tooth import (
    RectangularTooth as RectangularTooth,
    SectionBeam as SectionBeam,
    TableBeam as TableBeam,
    TrapezoidTooth as TrapezoidTooth,
    WedgeTooth as WedgeTooth,
    wedge_of_sawtooth as wedge_of_sawtooth,
)
