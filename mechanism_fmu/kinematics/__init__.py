"""Kinematic analysis as ME451 teaches it: degrees of freedom, dependent rows, position, velocity and acceleration.

`mobility` counts what the rows of a mechanism leave free, `analyse` follows a driven one, `cam_report` turns a cam
under its follower, and `profile_report` looks at a profile alone.
"""

from .cams import CamReport as CamReport, cam_report as cam_report
from .equations import KinematicsError as KinematicsError, SingularConfigurationError as SingularConfigurationError
from .mobility import Dependency as Dependency, Mobility as Mobility, mobility as mobility
from .motion import KinematicMotion as KinematicMotion, analyse as analyse
from .profiles import ProfileReport as ProfileReport, profile_report as profile_report
