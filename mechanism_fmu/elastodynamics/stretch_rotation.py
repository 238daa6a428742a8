"""Stretch–rotation operators: from the link vector of the rigid mechanism to that of the deformed one.

The paper names them ("Kineto-Elastodynamic Stretch Rotation Operators ... which will rotate and stretch both planar and
spatial link vectors") but its first pages, which we have, do not define them. These definitions are this project's.

A link vector r, from one end of a link to the other, becomes S r with S = (1 + epsilon) R: R turns it and 1 + epsilon
makes it longer. Both follow from u, by how much one end moves against the other in the linear theory (the difference of
two deflections delta): with the unit vector t of the link and its length l

    epsilon = t . u / l,        theta = t x u / l,        S = (1 + epsilon) R(theta).

Then S r = r + u + O(|u|^2 / l): the operators agree with the linear theory to second order, and turn by large angles as
well as small ones without ever changing the shape of what they turn.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .elements import FloatArray


def planar_operator(stretch: npt.ArrayLike, rotation: npt.ArrayLike) -> FloatArray:
    """S = (1 + epsilon) [[cos, -sin], [sin, cos]], shape (..., 2, 2).

    As a complex number it is (1 + epsilon) exp(i theta): planar operators of a chain commute, and multiply.

    Args:
        stretch: epsilon [-], shape (...).
        rotation: theta [rad], counter-clockwise, shape (...).

    Source: docs/explanation/elastodynamics-dynamics.md, eqs (K8) and (K9).
    """
    epsilon, theta = np.broadcast_arrays(np.asarray(stretch, dtype=float), np.asarray(rotation, dtype=float))
    c, s = (1.0 + epsilon) * np.cos(theta), (1.0 + epsilon) * np.sin(theta)
    return np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)


def spatial_operator(stretch: npt.ArrayLike, rotation: npt.ArrayLike) -> FloatArray:
    """S = (1 + epsilon) exp([theta]x), shape (..., 3, 3).

    Args:
        stretch: epsilon [-], shape (...).
        rotation: theta, the axis times the angle [rad], shape (..., 3).

    Source: docs/explanation/elastodynamics-dynamics.md, eqs (K8) and (K10): Rodrigues' formula.
    """
    theta = np.asarray(rotation, dtype=float)
    angle = np.linalg.norm(theta, axis=-1)[..., None, None]
    zero = np.zeros(theta.shape[:-1])
    x, y, z = np.moveaxis(theta, -1, 0)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*theta.shape[:-1], 3, 3)
    # sin a / a and (1 - cos a) / a^2, both smooth at 0; numpy's sinc has the factor pi inside.
    turn = np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(0.5 * angle / np.pi) ** 2 * (cross @ cross)
    return np.asarray((1.0 + np.asarray(stretch, dtype=float))[..., None, None] * turn)


def planar_deformation(link: npt.ArrayLike, displacement: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Stretch epsilon [-] and angle theta [rad], each of shape (...), of links whose ends move against each other.

    Args:
        link: r [m], shape (..., 2).
        displacement: u, of the end less that of the beginning [m], shape (..., 2).

    Raises:
        ValueError: a link has no length.

    Source: docs/explanation/elastodynamics-dynamics.md, eq (K8).
    """
    r, u = np.asarray(link, dtype=float), np.asarray(displacement, dtype=float)
    square = _square(r)
    return np.sum(r * u, axis=-1) / square, (r[..., 0] * u[..., 1] - r[..., 1] * u[..., 0]) / square


def spatial_deformation(link: npt.ArrayLike, displacement: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Stretch epsilon [-], shape (...), and angle theta [rad], shape (..., 3), of links by their ends.

    theta is perpendicular to the link: how far it turns about itself, no link vector can show.

    Args:
        link: r [m], shape (..., 3).
        displacement: u, of the end less that of the beginning [m], shape (..., 3).

    Raises:
        ValueError: a link has no length.

    Source: docs/explanation/elastodynamics-dynamics.md, eq (K8).
    """
    r, u = np.asarray(link, dtype=float), np.asarray(displacement, dtype=float)
    square = _square(r)
    return np.sum(r * u, axis=-1) / square, np.asarray(np.cross(r, u)) / square[..., None]


def deformed_links(link: npt.ArrayLike, displacement: npt.ArrayLike) -> FloatArray:
    """S r [m], in the shape of `link`.

    Args:
        link: r [m], shape (..., 2) or (..., 3).
        displacement: u, of the end less that of the beginning [m], in the shape of `link`.

    Raises:
        ValueError: a link has no length.

    Source: docs/explanation/elastodynamics-dynamics.md, eqs (K8) to (K10).
    """
    r = np.asarray(link, dtype=float)
    if r.shape[-1] == 2:
        operator = planar_operator(*planar_deformation(r, displacement))
    else:
        operator = spatial_operator(*spatial_deformation(r, displacement))
    return np.asarray((operator @ r[..., None])[..., 0])


def _square(link: FloatArray) -> FloatArray:
    square = np.asarray(np.sum(link**2, axis=-1))
    if not np.all(square > 0.0):
        raise ValueError("a link has no length, so there is nothing to stretch or turn: its two ends must differ.")
    return square
