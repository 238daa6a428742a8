"""The two numerical examples of the ME451 slides on gears and cams, worked with the joints of this project.

`carried_gear` and `falling_gear` are example 3.4.1, gear 2 around the fixed gear 1: driven, and under its weight.
`cam_tangent` and `roller_tangent` are the tangents g_1 and g_2 of the cam example, written out; `tangents_of_the_rows`
has the same two vectors as the constraint rows of this project use them.
"""

from .cam import CAM, ROLLER, cam_tangent, roller_tangent, tangents_of_the_rows
from .gears import CARRIER, MARK_1, MARK_2, RADIUS_1, RADIUS_2, Fall, carried_gear, falling_gear, rolled_angle

__all__ = [
    "CAM",
    "CARRIER",
    "MARK_1",
    "MARK_2",
    "RADIUS_1",
    "RADIUS_2",
    "ROLLER",
    "Fall",
    "cam_tangent",
    "carried_gear",
    "falling_gear",
    "rolled_angle",
    "roller_tangent",
    "tangents_of_the_rows",
]
