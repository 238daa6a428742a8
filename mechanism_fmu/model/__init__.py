"""What a mechanism is: frozen records with SI units, and no numerics."""

from ..codes import EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH
from .body import GROUND, Body
from .compile import MechanismTables
from .contacts import AngleLock, AngleStop, Contact, PointLineContact
from .curves import Curve, Piece, Term
from .drawing import Bar, Disc, Hinge, Shape, Striker, Wheel
from .errors import MechanismError
from .findings import Finding
from .forces import CompliantShaft, Damper, Force, Torque, TorsionSpring
from .joints import (
    AngleDriver,
    CamFlatFollower,
    CamFollower,
    Distance,
    DistanceDriver,
    Gears,
    InternalGears,
    PointFollower,
    RackAndPinion,
    Revolute,
    RevoluteTranslational,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
)
from .logic import LogicalFunction
from .mechanism import Mechanism, Settings
from .model import Model
from .patterns import CircularPattern
from .ports import Calculated, Input, Output, Parameter

__all__ = [
    "EVENT_BUFFER_LENGTH",
    "GROUND",
    "IMPACT_BUFFER_LENGTH",
    "AngleDriver",
    "AngleLock",
    "AngleStop",
    "Bar",
    "Body",
    "Calculated",
    "CamFlatFollower",
    "CamFollower",
    "CircularPattern",
    "CompliantShaft",
    "Contact",
    "Curve",
    "Damper",
    "Disc",
    "Distance",
    "DistanceDriver",
    "Finding",
    "Force",
    "Gears",
    "Hinge",
    "Input",
    "InternalGears",
    "LogicalFunction",
    "Mechanism",
    "MechanismError",
    "MechanismTables",
    "Model",
    "Output",
    "Parameter",
    "Piece",
    "PointFollower",
    "PointLineContact",
    "RackAndPinion",
    "Revolute",
    "RevoluteTranslational",
    "Settings",
    "Shape",
    "Striker",
    "Term",
    "Torque",
    "TorsionSpring",
    "Translational",
    "TranslationalDriver",
    "Wheel",
    "XDriver",
    "YDriver",
]
