"""What can go wrong in kinematic analysis."""

from __future__ import annotations


class KinematicsError(ValueError):
    """The mechanism cannot be analysed as asked; the message says why and what to do."""


class SingularConfigurationError(KinematicsError):
    """The rank of the constraint rows drops: the motion may go on along more than one branch, or not at all."""
