"""What joints are; how they are enforced is in `mechanism_fmu.engine.constraints.joints`."""

from .angle_driver import AngleDriver
from .cam_flat_follower import CamFlatFollower
from .cam_follower import CamFollower
from .distance import Distance
from .distance_driver import DistanceDriver
from .gears import Gears
from .internal_gears import InternalGears
from .point_follower import PointFollower
from .rack_and_pinion import RackAndPinion
from .revolute import Revolute
from .revolute_translational import RevoluteTranslational
from .translational import Translational
from .translational_driver import TranslationalDriver
from .x_driver import XDriver
from .y_driver import YDriver

#: Any driver.
Driver = XDriver | YDriver | AngleDriver | DistanceDriver | TranslationalDriver

#: Any joint.
Joint = (
    Revolute
    | Translational
    | Distance
    | RevoluteTranslational
    | Gears
    | InternalGears
    | RackAndPinion
    | XDriver
    | YDriver
    | AngleDriver
    | DistanceDriver
    | TranslationalDriver
)

#: Any higher pair: a joint by the textbook, and a contact that may open.
HigherPair = CamFollower | CamFlatFollower | PointFollower

__all__ = [
    "AngleDriver",
    "CamFlatFollower",
    "CamFollower",
    "Distance",
    "DistanceDriver",
    "Driver",
    "Gears",
    "HigherPair",
    "InternalGears",
    "Joint",
    "PointFollower",
    "RackAndPinion",
    "Revolute",
    "RevoluteTranslational",
    "Translational",
    "TranslationalDriver",
    "XDriver",
    "YDriver",
]
