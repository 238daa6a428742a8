"""Kinematic analysis as ME451 teaches it: degrees of freedom, dependent rows, position, velocity and acceleration.

`mobility` counts what the rows of a mechanism leave free, `analyse` follows a driven one, `cam_report` turns a cam
under its follower, and `profile_report` looks at a profile alone.
"""

from .cams import CamReport, cam_report
from .errors import KinematicsError, SingularConfigurationError
from .mobility import Dependency, Mobility, mobility
from .motion import KinematicMotion, analyse
from .profiles import ProfileReport, profile_report

__all__ = [
    "CamReport",
    "Dependency",
    "KinematicMotion",
    "KinematicsError",
    "Mobility",
    "ProfileReport",
    "SingularConfigurationError",
    "analyse",
    "cam_report",
    "mobility",
    "profile_report",
]
