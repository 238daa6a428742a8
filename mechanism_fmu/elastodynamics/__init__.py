"""Kineto-elastodynamics: the linkage bends (Erdman, Sandor and Oakberg 1972); theory in docs/elastodynamics.md.

`linkage` makes a structure of a mechanism with members, `configurations` follows it along a motion: compatibility,
transfer of forces, flexibility and stiffness in all configurations at once. `quasi_static` bends it by the inertia of
the rigid motion and by loads, with stresses, reactions, input torque and power.

`elastic_cycle` makes the equations of a linkage that swings (docs/elastodynamics-dynamics.md), `periodic_response` is
their steady state; `lightest` looks for the lightest design.
"""

from .configuration import Configurations, configurations
from .consistent import consistent_load, consistent_mass
from .cycle import Cycle, Power, quasi_static
from .dynamics import MassModel, deflection_of, elastic_cycle, stress_of
from .elastic_cycle import ElasticCycle
from .elements import bent_coupler, cantilever, spatial_link, supported_beam, torsion_shaft, two_force_member
from .errors import LinkageError
from .feedback import Feedback, fed_back
from .fluctuation import Fluctuation, Flywheel, flywheel, torque_fluctuation
from .frequencies import InstantaneousModes, instantaneous_modes
from .friction import with_friction
from .gear_tooth import GearTooth
from .judgement import Judgement, judge_quasi_static, judge_steady_state, member_mass, rigid_path
from .linkage import Element, Linkage, linkage
from .masses import inertia_forces, lumps, mass_matrix, system_forces
from .peak import peak
from .periodic import PeriodicResponse, periodic_response
from .ports import ElasticPorts, elastic_ports
from .reactions import JointForce, Reactions, joint_forces, power_of, reactions
from .resized import Resized, resized_members
from .shaking import Shaking, crank_hinge, momentum_shaking, shaking
from .simulated import simulated_motion
from .speeds import SpeedSweep, critical_speeds, speed_sweep
from .stresses import largest_stress, section_forces
from .stretch_rotation import deformed_links, planar_deformation, planar_operator, spatial_deformation, spatial_operator
from .synthesis import Synthesis, lightest
from .tapered import VaryingBeam, tapered_cantilever, tapered_end_moment
from .transient import Transient, growth_per_period, transient
from .turn import DRIVE, crank_of, turn
from .unlike import unlike_bodies

__all__ = [
    "DRIVE",
    "Configurations",
    "Cycle",
    "ElasticCycle",
    "ElasticPorts",
    "Element",
    "Feedback",
    "Fluctuation",
    "Flywheel",
    "GearTooth",
    "InstantaneousModes",
    "JointForce",
    "Judgement",
    "Linkage",
    "LinkageError",
    "MassModel",
    "PeriodicResponse",
    "Power",
    "Reactions",
    "Resized",
    "Shaking",
    "SpeedSweep",
    "Synthesis",
    "Transient",
    "VaryingBeam",
    "bent_coupler",
    "cantilever",
    "configurations",
    "consistent_load",
    "consistent_mass",
    "crank_hinge",
    "crank_of",
    "critical_speeds",
    "deflection_of",
    "deformed_links",
    "elastic_cycle",
    "elastic_ports",
    "fed_back",
    "flywheel",
    "growth_per_period",
    "inertia_forces",
    "instantaneous_modes",
    "joint_forces",
    "judge_quasi_static",
    "judge_steady_state",
    "largest_stress",
    "lightest",
    "linkage",
    "lumps",
    "mass_matrix",
    "member_mass",
    "momentum_shaking",
    "peak",
    "periodic_response",
    "planar_deformation",
    "planar_operator",
    "power_of",
    "quasi_static",
    "reactions",
    "resized_members",
    "rigid_path",
    "section_forces",
    "shaking",
    "simulated_motion",
    "spatial_deformation",
    "spatial_link",
    "spatial_operator",
    "speed_sweep",
    "stress_of",
    "supported_beam",
    "system_forces",
    "tapered_cantilever",
    "tapered_end_moment",
    "torque_fluctuation",
    "torsion_shaft",
    "transient",
    "turn",
    "two_force_member",
    "unlike_bodies",
    "with_friction",
]
