"""Stress recovery: bending moment and stress along the tooth after an impact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .beam import Beam
from .checks import FloatArray, require_all_within, require_impact_velocity
from .field import BendingField
from .material import Material
from .modes import ritz_modes
from .natural_mode import Mode

#: Latest time [s] since the impact; it only keeps the phase of the fastest tooth finite.
_LATEST_TIME = 1e9


def bending_moment(
    tooth: Beam,
    material: Material,
    impact_velocity: float,
    x: npt.ArrayLike,
    t: npt.ArrayLike,
    modes: Sequence[Mode] | None = None,
) -> FloatArray:
    """Bending moment M_b = -E I_n w'' [N m], of shape (len(x), len(t)).

    Arguments, errors and source are those of `bending_stress`.
    """
    places, times = checked(tooth, impact_velocity, x, t)
    return impact_velocity * _field(tooth, material, modes).moment(places, times)


def bending_stress(
    tooth: Beam,
    material: Material,
    impact_velocity: float,
    x: npt.ArrayLike,
    t: npt.ArrayLike,
    modes: Sequence[Mode] | None = None,
) -> FloatArray:
    """Bending stress sigma_b = M_b / W_b of the outer fibre [Pa], of shape (len(x), len(t)).

    At the tip, where M_b and W_b vanish, it is their limit: zero.

    Args:
        tooth: the beam.
        material: what it is made of.
        impact_velocity: |v_I| [m/s], >= 0: the tooth's length times the jump of the wheel's rate in the impact,
            l |omega_after - omega_before|.
        x: distances from the root [m], from 0 to the length of the tooth; a number or shape (n,).
        t: times since the impact [s], 0 to 1e9; a number or shape (m,).
        modes: the modes that take part; without them the two of `ritz_modes`, as in the paper.

    Raises:
        ValueError: when velocity, a place or a time is outside its limits or not a number, or `modes` is empty.

    Source: Pennestrì, Valentini, Vita, eqs (13), (16).
    """
    places, times = checked(tooth, impact_velocity, x, t)
    return impact_velocity * _field(tooth, material, modes).stress(places, times)


def _field(tooth: Beam, material: Material, modes: Sequence[Mode] | None) -> BendingField:
    return BendingField(tooth, material, ritz_modes(tooth, material) if modes is None else modes)


def checked(tooth: Beam, impact_velocity: float, x: npt.ArrayLike, t: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Places and times as one-dimensional arrays, after refusing what cannot be right."""
    places = np.atleast_1d(np.asarray(x, dtype=np.float64))
    times = np.atleast_1d(np.asarray(t, dtype=np.float64))
    require_impact_velocity(impact_velocity)
    require_all_within("place", places, 0.0, tooth.length, "m", "x runs from the root to the tip of the tooth")
    require_all_within("time", times, 0.0, _LATEST_TIME, "s", "t counts from the impact")
    return places, times
