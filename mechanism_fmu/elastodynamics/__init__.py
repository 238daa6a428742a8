"""Kineto-elastodynamics: the linkage bends (Erdman, Sandor and Oakberg 1972); theory in docs/elastodynamics.md.

`linkage` makes a structure of a mechanism with members, `configurations` follows it along a motion: compatibility,
transfer of forces, flexibility and stiffness in all configurations at once.
"""

from .configuration import Configurations, configurations
from .elements import bent_coupler, cantilever, spatial_link, supported_beam, torsion_shaft, two_force_member
from .errors import LinkageError
from .linkage import Element, Linkage, linkage
from .masses import inertia_forces, lumps, mass_matrix, system_forces

__all__ = [
    "Configurations",
    "Element",
    "Linkage",
    "LinkageError",
    "bent_coupler",
    "cantilever",
    "configurations",
    "inertia_forces",
    "linkage",
    "lumps",
    "mass_matrix",
    "spatial_link",
    "supported_beam",
    "system_forces",
    "torsion_shaft",
    "two_force_member",
]
