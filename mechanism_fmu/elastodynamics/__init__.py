"""Kineto-elastodynamics: the linkage bends (Erdman, Sandor and Oakberg 1972); theory in docs/elastodynamics.md.

`linkage` makes a structure of a mechanism with members, `configurations` follows it along a motion: compatibility,
transfer of forces, flexibility and stiffness in all configurations at once.
"""

from .configuration import Configurations, configurations
from .cycle import Cycle, Power, quasi_static
from .elements import bent_coupler, cantilever, spatial_link, supported_beam, torsion_shaft, two_force_member
from .errors import LinkageError
from .fluctuation import Fluctuation, torque_fluctuation
from .linkage import Element, Linkage, linkage
from .masses import inertia_forces, lumps, mass_matrix, system_forces

__all__ = [
    "Configurations",
    "Cycle",
    "Element",
    "Fluctuation",
    "Linkage",
    "LinkageError",
    "Power",
    "bent_coupler",
    "cantilever",
    "configurations",
    "inertia_forces",
    "linkage",
    "lumps",
    "mass_matrix",
    "quasi_static",
    "spatial_link",
    "supported_beam",
    "system_forces",
    "torque_fluctuation",
    "torsion_shaft",
    "two_force_member",
]
