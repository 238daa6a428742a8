"""The drawings of the pages of joints.

python -m docs.joints.drawings      rewrites the .svg files beside this file, in the root of a clone
"""

from __future__ import annotations

from pathlib import Path

from .cam_drawings import cam_flat_follower, cam_follower, point_follower
from .driver_drawing import drivers
from .gear_drawings import gears, gears_falling, internal_gears, rack_and_pinion
from .lower_pair_drawings import distance, revolute, revolute_translational, translational
from .profile_drawings import motion_laws, slides_cam

DRAWINGS = {
    "revolute": revolute,
    "translational": translational,
    "distance": distance,
    "revolute_translational": revolute_translational,
    "gears": gears,
    "gears_falling": gears_falling,
    "internal_gears": internal_gears,
    "rack_and_pinion": rack_and_pinion,
    "drivers": drivers,
    "cam_follower": cam_follower,
    "cam_flat_follower": cam_flat_follower,
    "point_follower": point_follower,
    "motion_laws": motion_laws,
    "slides_cam": slides_cam,
}


def main() -> None:
    """Rewrite all drawings."""
    for name, draw in DRAWINGS.items():
        (Path(__file__).parent / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
