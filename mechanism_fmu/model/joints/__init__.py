"""What joints are; how they are enforced is in `mechanism_fmu.engine.joints`."""

from .revolute import Revolute
from .translational import Translational

#: Any joint.
Joint = Revolute | Translational

__all__ = ["Joint", "Revolute", "Translational"]
