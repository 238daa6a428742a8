"""What a mechanism is: frozen records with SI units, and no numerics."""

from ..codes import EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH
from .body import GROUND, Body
from .compile import MechanismTables
from .contacts import AngleLock, AngleStop, Contact, PointLineContact
from .drawing import Bar, Disc, Hinge, Shape, Striker, Wheel
from .errors import MechanismError
from .findings import Finding
from .forces import CompliantShaft, Damper, Force, Torque, TorsionSpring
from .joints import Revolute, Translational
from .logic import LogicalFunction
from .mechanism import Mechanism, Settings
from .model import Model
from .patterns import CircularPattern
from .ports import Calculated, Input, Output, Parameter

__all__ = [
    "EVENT_BUFFER_LENGTH",
    "GROUND",
    "IMPACT_BUFFER_LENGTH",
    "AngleLock",
    "AngleStop",
    "Bar",
    "Body",
    "Calculated",
    "CircularPattern",
    "CompliantShaft",
    "Contact",
    "Damper",
    "Disc",
    "Finding",
    "Force",
    "Hinge",
    "Input",
    "LogicalFunction",
    "Mechanism",
    "MechanismError",
    "MechanismTables",
    "Model",
    "Output",
    "Parameter",
    "PointLineContact",
    "Revolute",
    "Settings",
    "Shape",
    "Striker",
    "Torque",
    "TorsionSpring",
    "Translational",
    "Wheel",
]
