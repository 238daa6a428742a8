"""Kineto-elastodynamics: the linkage bends (Erdman, Sandor and Oakberg 1972); docs/explanation/elastodynamics.md.

`linkage` makes a structure of a mechanism with members, `configurations` follows it along a motion: compatibility,
transfer of forces, flexibility and stiffness in all configurations at once. `quasi_static` bends it by the inertia of
the rigid motion and by loads, with stresses, reactions, input torque and power.

`elastic_cycle` makes the equations of a linkage that swings (docs/explanation/elastodynamics-dynamics.md),
`periodic_response` is their steady state; `lightest` looks for the lightest design.
"""

from .cycle import (
    Cycle as Cycle,
    Fluctuation as Fluctuation,
    Flywheel as Flywheel,
    Power as Power,
    Shaking as Shaking,
    crank_hinge as crank_hinge,
    flywheel as flywheel,
    momentum_shaking as momentum_shaking,
    quasi_static as quasi_static,
    shaking as shaking,
    torque_fluctuation as torque_fluctuation,
)
from .elastic_cycle import (
    ElasticCycle as ElasticCycle,
    InstantaneousModes as InstantaneousModes,
    MassModel as MassModel,
    deflection_of as deflection_of,
    elastic_cycle as elastic_cycle,
    instantaneous_modes as instantaneous_modes,
    stress_of as stress_of,
)
from .elements import (
    LinkageError as LinkageError,
    VaryingBeam as VaryingBeam,
    bent_coupler as bent_coupler,
    cantilever as cantilever,
    spatial_link as spatial_link,
    supported_beam as supported_beam,
    tapered_cantilever as tapered_cantilever,
    torsion_shaft as torsion_shaft,
    two_force_member as two_force_member,
)
from .fourier import peak as peak
from .gear_tooth import GearTooth as GearTooth
from .reaction_forces import (
    JointForce as JointForce,
    Reactions as Reactions,
    joint_forces as joint_forces,
    power_of as power_of,
    reactions as reactions,
    with_friction as with_friction,
)
from .responses import (
    Feedback as Feedback,
    PeriodicResponse as PeriodicResponse,
    SpeedSweep as SpeedSweep,
    critical_speeds as critical_speeds,
    fed_back as fed_back,
    growth_per_period as growth_per_period,
    periodic_response as periodic_response,
    speed_sweep as speed_sweep,
)
from .stretch_rotation import (
    deformed_links as deformed_links,
    planar_deformation as planar_deformation,
    planar_operator as planar_operator,
    spatial_deformation as spatial_deformation,
    spatial_operator as spatial_operator,
)
from .structure.configuration import Configurations as Configurations, configurations as configurations
from .structure.linkage import (
    Element as Element,
    Linkage as Linkage,
    Resized as Resized,
    largest_stress as largest_stress,
    linkage as linkage,
    resized_members as resized_members,
    section_forces as section_forces,
    unlike_bodies as unlike_bodies,
)
from .structure.masses import (
    consistent_load as consistent_load,
    consistent_mass as consistent_mass,
    inertia_forces as inertia_forces,
    lumps as lumps,
    mass_matrix as mass_matrix,
    system_forces as system_forces,
)
from .synthesis import (
    Judgement as Judgement,
    Synthesis as Synthesis,
    judge_quasi_static as judge_quasi_static,
    judge_steady_state as judge_steady_state,
    lightest as lightest,
    member_mass as member_mass,
    rigid_path as rigid_path,
)
from .turn import (
    DRIVE as DRIVE,
    ElasticPorts as ElasticPorts,
    crank_of as crank_of,
    elastic_ports as elastic_ports,
    turn as turn,
)
