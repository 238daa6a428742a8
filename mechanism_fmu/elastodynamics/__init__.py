"""Kineto-elastodynamics: the linkage bends (Erdman, Sandor and Oakberg 1972); theory in docs/elastodynamics.md.

`linkage` makes a structure of a mechanism with members, `configurations` follows it along a motion: compatibility,
transfer of forces, flexibility and stiffness in all configurations at once. `quasi_static` bends it by the inertia of
the rigid motion and by loads, with stresses, reactions, input torque and power.
"""

from .configuration import Configurations, configurations
from .cycle import Cycle, Power, quasi_static
from .elements import bent_coupler, cantilever, spatial_link, supported_beam, torsion_shaft, two_force_member
from .errors import LinkageError
from .fluctuation import Fluctuation, torque_fluctuation
from .linkage import Element, Linkage, linkage
from .masses import inertia_forces, lumps, mass_matrix, system_forces
from .reactions import Reactions, power_of, reactions
from .simulated import simulated_motion
from .stresses import largest_stress, section_forces

__all__ = [
    "Configurations",
    "Cycle",
    "Element",
    "Fluctuation",
    "Linkage",
    "LinkageError",
    "Power",
    "Reactions",
    "bent_coupler",
    "cantilever",
    "configurations",
    "inertia_forces",
    "largest_stress",
    "linkage",
    "lumps",
    "mass_matrix",
    "power_of",
    "quasi_static",
    "reactions",
    "section_forces",
    "simulated_motion",
    "spatial_link",
    "supported_beam",
    "system_forces",
    "torque_fluctuation",
    "torsion_shaft",
    "two_force_member",
]
