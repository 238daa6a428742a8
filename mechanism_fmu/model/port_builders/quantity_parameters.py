"""Parameters by what they measure, with the limits that keep the numerics sound; `start` is in the SI unit."""

from __future__ import annotations

from ..ports import Parameter


def length_parameter(name: str, start: float, description: str, minimum: float = 1e-6) -> Parameter:
    """A length [m], from `minimum` to 1 km; not zero if nothing else is said."""
    return Parameter(name, start, description, "m", minimum, 1e3)


def angle_parameter(
    name: str, start: float, description: str, minimum: float = -1e3, maximum: float = 1e3
) -> Parameter:
    """An angle [rad], shown in degrees."""
    return Parameter(name, start, description, "rad", minimum, maximum, display_unit="deg")


def speed_parameter(name: str, start: float, description: str) -> Parameter:
    """An angular velocity [rad/s], shown in rpm."""
    return Parameter(name, start, description, "rad/s", -1e6, 1e6, display_unit="rpm")


def mass_parameter(name: str, start: float, description: str) -> Parameter:
    """A mass [kg], not zero."""
    return Parameter(name, start, description, "kg", 1e-12, 1e6)


def inertia_parameter(name: str, start: float, description: str) -> Parameter:
    """A moment of inertia [kg.m2], not zero."""
    return Parameter(name, start, description, "kg.m2", 1e-12, 1e6)


def stiffness_parameter(name: str, start: float, description: str) -> Parameter:
    """Stiffness of a torsion spring [N.m/rad], which may be zero."""
    return Parameter(name, start, description, "N.m/rad", 0.0, 1e6)


def torque_parameter(name: str, start: float, description: str) -> Parameter:
    """A torque [N.m]."""
    return Parameter(name, start, description, "N.m", -1e6, 1e6)


def fraction_parameter(name: str, start: float, description: str) -> Parameter:
    """A number from 0 to 1, such as a coefficient of restitution."""
    return Parameter(name, start, description, "1", 0.0, 1.0)


def flag_parameter(name: str, start: bool, description: str) -> Parameter:
    """Yes or no; the function of the mechanism gets 1 or 0."""
    return Parameter(name, float(start), description, type="Boolean")
