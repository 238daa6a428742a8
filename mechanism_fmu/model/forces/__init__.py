"""Force elements, by what they act on; a new one is a class here and a function in `mechanism_fmu.engine.dynamics`."""

from .at_points import Bushing, Force, PointForce, SpringDamper
from .base import Element as Element, Quantity as Quantity
from .by_law import NonlinearSpring, NonlinearTorsionSpring
from .driven import Brake, DCMotor
from .markers import Marker
from .oscillation import Oscillation
from .torsional import CompliantShaft, Damper, Torque, TorsionSpring, TorsionSpringDamper

__all__ = [
    "Brake",
    "Bushing",
    "CompliantShaft",
    "DCMotor",
    "Damper",
    "Force",
    "Marker",
    "NonlinearSpring",
    "NonlinearTorsionSpring",
    "Oscillation",
    "PointForce",
    "SpringDamper",
    "Torque",
    "TorsionSpring",
    "TorsionSpringDamper",
]

#: Any force element.
ForceElement = (
    Torque
    | TorsionSpring
    | Damper
    | CompliantShaft
    | Force
    | Brake
    | DCMotor
    | SpringDamper
    | TorsionSpringDamper
    | PointForce
    | Bushing
    | NonlinearSpring
    | NonlinearTorsionSpring
    | Marker
    | Oscillation
)
