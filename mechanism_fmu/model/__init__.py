"""What a mechanism is: frozen records with SI units, and no numerics."""

from ..codes import EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH
from .body import GROUND, Body
from .compile import MechanismTables
from .contacts import AngleLock, AngleStop, Contact, PointLineContact
from .curves import Curve, Piece, Term, constant, cosine, sine
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
from .motion_laws import Law, Move, cycloidal, dwell, modified_sine, polynomial_345
from .motions import harmonic_motion, polynomial_motion, table_motion
from .patterns import CircularPattern
from .ports import Calculated, Input, Output, Parameter
from .profiles import circle, harmonic_profile, motion_profile, piecewise_profile, slot, spline_profile

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
    "Law",
    "LogicalFunction",
    "Mechanism",
    "MechanismError",
    "MechanismTables",
    "Model",
    "Move",
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
    "circle",
    "constant",
    "cosine",
    "cycloidal",
    "dwell",
    "harmonic_motion",
    "harmonic_profile",
    "modified_sine",
    "motion_profile",
    "piecewise_profile",
    "polynomial_345",
    "polynomial_motion",
    "sine",
    "slot",
    "spline_profile",
    "table_motion",
]
