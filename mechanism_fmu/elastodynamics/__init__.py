"""Kineto-elastodynamics: the linkage bends (Erdman, Sandor and Oakberg 1972); theory in docs/elastodynamics.md.

`linkage` makes a structure of a mechanism with members, `configurations` follows it along a motion: compatibility,
transfer of forces, flexibility and stiffness in all configurations at once. `quasi_static` bends it by the inertia of
the rigid motion and by loads, with stresses, reactions, input torque and power.
"""

from .configuration import Configurations, configurations
from .cycle import Cycle, Power, quasi_static
from .dynamics import deflection_of, elastic_cycle, stress_of
from .elastic_cycle import ElasticCycle
from .elements import bent_coupler, cantilever, spatial_link, supported_beam, torsion_shaft, two_force_member
from .errors import LinkageError
from .fluctuation import Fluctuation, torque_fluctuation
from .frequencies import InstantaneousModes, instantaneous_modes
from .linkage import Element, Linkage, linkage
from .masses import inertia_forces, lumps, mass_matrix, system_forces
from .peak import peak
from .periodic import PeriodicResponse, periodic_response
from .ports import ElasticPorts, elastic_ports
from .reactions import Reactions, power_of, reactions
from .simulated import simulated_motion
from .speeds import critical_speeds
from .stresses import largest_stress, section_forces
from .turn import DRIVE, crank_of, turn

__all__ = [
    "DRIVE",
    "Configurations",
    "Cycle",
    "ElasticCycle",
    "ElasticPorts",
    "Element",
    "Fluctuation",
    "InstantaneousModes",
    "Linkage",
    "LinkageError",
    "PeriodicResponse",
    "Power",
    "Reactions",
    "bent_coupler",
    "cantilever",
    "configurations",
    "crank_of",
    "critical_speeds",
    "deflection_of",
    "elastic_cycle",
    "elastic_ports",
    "inertia_forces",
    "instantaneous_modes",
    "largest_stress",
    "linkage",
    "lumps",
    "mass_matrix",
    "peak",
    "periodic_response",
    "power_of",
    "quasi_static",
    "reactions",
    "section_forces",
    "simulated_motion",
    "spatial_link",
    "stress_of",
    "supported_beam",
    "system_forces",
    "torque_fluctuation",
    "torsion_shaft",
    "turn",
    "two_force_member",
]
