"""The largest bending stress that an impact leaves in a tooth, over length and time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from .beam import Beam, FloatArray, require_impact_velocity, require_within
from .material import Material
from .modes import WEDGE, converged_modes, ritz_modes
from .recovery import BendingField
from .ritz import Mode
from .tooth import WedgeTooth

# How finely ringing must be looked at: fast modes die first.


class Stretch(NamedTuple):
    """A part of the time after an impact: begin and end [s], and the fastest mode that is heard in it [rad/s]."""

    begin: float
    end: float
    frequency: float


def audible_stretches(
    loudness: FloatArray, frequencies: FloatArray, damping_ratio: float, threshold: float, until: float
) -> Iterator[Stretch]:
    """Parts of the time from an impact to `until` [s], in each of which one mode is the fastest of those still heard.

    A mode is heard while its amplitude, loudness exp(-zeta Lambda t), is above the threshold. All modes have one
    damping ratio, so the fast ones fall silent first. The slowest mode counts as heard to the end.

    Args:
        loudness: amplitude of each mode just after the impact, in any unit, of shape (modes,).
        frequencies: Lambda of each [rad/s], of shape (modes,).
        damping_ratio: zeta of all, > 0.
        threshold: in the unit of the loudness, > 0.
        until: end of the last stretch [s].
    """
    with np.errstate(divide="ignore"):
        ends = np.log(loudness / threshold) / (damping_ratio * frequencies)
    fastest_first = np.argsort(-frequencies)
    ends[fastest_first[-1]] = math.inf
    begin = 0.0
    for mode in fastest_first:
        end = min(float(ends[mode]), until)
        if end > begin:
            yield Stretch(begin, end, float(frequencies[mode]))
            begin = end


# Search for the largest stress over length and time: a grid brackets the maxima, bounded descent locates them.

#: Cells of the grid along the tooth, at least so many for each mode, and in a period of the fastest mode still heard.
_CELLS_OF_LENGTH = 32
_CELLS_OF_MODE = 4
_CELLS_OF_PERIOD = 64

#: A local maximum lies less than this fraction above the highest grid point beside it (1e-3 for the paper's modes).
_GRID_ERROR = 0.01

#: A mode is heard above this part of what the loudest starts with. Quieter ones belong to every value, but they
#: no longer set the pace of the grid.
_HEARD = 1e-5

#: Times that are looked at together, so that little damping takes no more memory.
_BLOCK = 4096

#: A located maximum may lie this many cells away from its grid point.
_REACH = 2

#: Points, in cells, of the central differences that give the slope of the stress at the middle one.
_DIFFERENCE = 1e-3
_STENCIL = np.array([-1.0, 0.0, 1.0])
#: So many steps are taken at most; one of so little [cells] changes no digit of the largest value.
_ROUNDS = 50
_FINE = 1e-8


class StressPoint(NamedTuple):
    """|sigma_b| [Pa per m/s], the distance from the root [m] and the time since the impact [s] at which it acts."""

    stress: float
    x: float
    t: float


def largest_stress(field: BendingField) -> StressPoint:
    """The largest |sigma_b| over the length of the tooth and over all times after the impact.

    Every local maximum that the grid cannot distinguish from the largest is located, and the largest of them is taken.
    """
    cells = max(_CELLS_OF_LENGTH, _CELLS_OF_MODE * len(field.frequencies))
    x = np.linspace(0.0, field.length, cells + 1)
    t = _times(field, x, _horizon(field, x))
    steps = np.diff(t, append=2 * t[-1] - t[-2])
    bounds, decay = field.stress_bounds(x), field.damping_ratio * field.frequencies
    largest = 0.0
    peaks: list[tuple[float, int, int]] = []
    for begin in range(0, len(t), _BLOCK):
        if (1 + _GRID_ERROR) * (bounds @ np.exp(-decay * t[begin])).max() < largest:
            break
        margin = min(begin, 1)  # so that peaks at either end of a block have their neighbours
        stress = np.abs(field.stress(x, t[begin - margin : begin + _BLOCK + 1]))
        highest_around = sliding_window_view(np.pad(stress, 1), (3, 3)).max(axis=(2, 3))
        largest = max(largest, float(stress.max()))
        found = np.argwhere((stress == highest_around) & (stress > (1 - _GRID_ERROR) * largest))
        peaks += [(stress[i, j], i, begin - margin + j) for i, j in found]
    candidates = {(i, j) for height, i, j in peaks if height > (1 - _GRID_ERROR) * largest}
    return max(_locate(field, (x[i], t[j]), (field.length / cells, steps[j])) for i, j in candidates)


def _horizon(field: BendingField, x: FloatArray) -> float:
    """Time [s] after which the stress stays below the largest of the first swing, that of the slowest mode.

    The bound of the stress decays at least as fast as the slowest mode.
    """
    slowest = float(field.frequencies.min())
    first_swing = np.abs(field.stress(x, _times(field, x, math.pi / slowest))).max()
    bound = (1 + _GRID_ERROR) * field.stress_bounds(x).sum(axis=1).max()
    return math.log(bound / first_swing) / (field.damping_ratio * slowest)


def _times(field: BendingField, x: FloatArray, until: float) -> FloatArray:
    """Times from 0 to `until` [s], as close as the fastest mode needs that is still heard, of shape (n,), n >= 2."""
    loudness = field.stress_bounds(x).max(axis=0)
    threshold = _HEARD * float(loudness.max())
    pieces = [np.zeros(1)]
    for stretch in audible_stretches(loudness, field.frequencies, field.damping_ratio, threshold, until):
        cells = math.ceil((stretch.end - stretch.begin) * stretch.frequency / (2 * math.pi) * _CELLS_OF_PERIOD)
        pieces.append(np.linspace(stretch.begin, stretch.end, cells + 1)[1:])
    return np.concatenate(pieces)


def _locate(field: BendingField, centre: tuple[float, float], cell: tuple[float, float]) -> StressPoint:
    """The maximum of |sigma_b| near a grid point (x, t), found in units of cells from there.

    By Newton's method within bounds: a coordinate that stands at its bound and wants beyond stays; where the stress is
    not curved downwards, or a step would lower it, a shorter way uphill is taken.
    """
    low = np.array([max(-_REACH, -centre[0] / cell[0]), max(-_REACH, -centre[1] / cell[1])])
    high = np.array([min(_REACH, (field.length - centre[0]) / cell[0]), _REACH])

    def stress_around(point: FloatArray) -> FloatArray:
        x, t = (c + size * (at + _DIFFERENCE * _STENCIL) for c, size, at in zip(centre, cell, point, strict=True))
        return field.stress(x, t)

    point = np.zeros(2)
    scale = stress_around(point)[1, 1]
    values = stress_around(point) / scale
    for _ in range(_ROUNDS):
        move = _uphill(values, point, low, high)
        while True:
            tried = np.clip(point + move, low, high)
            found = stress_around(tried) / scale
            if found[1, 1] >= values[1, 1] or np.abs(move).max() <= _FINE:
                break
            move = move / 4
        if found[1, 1] < values[1, 1]:
            break
        moved = float(np.abs(tried - point).max())
        point, values = tried, found
        if moved <= _FINE:
            break
    x, t = (float(c + size * at) for c, size, at in zip(centre, cell, point, strict=True))
    return StressPoint(abs(float(values[1, 1] * scale)), x, t)


def _uphill(values: FloatArray, point: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """A step from the middle of a stencil to where the values should be largest, shape (2,), in cells."""
    slope = np.array([values[2, 1] - values[0, 1], values[1, 2] - values[1, 0]]) / (2 * _DIFFERENCE)
    along = np.array([values[2, 1] + values[0, 1], values[1, 2] + values[1, 0]]) - 2 * values[1, 1]
    across = (values[2, 2] - values[2, 0] - values[0, 2] + values[0, 0]) / 4
    bend = np.array([[along[0], across], [across, along[1]]]) / _DIFFERENCE**2
    free = ~(((point <= low) & (slope < 0.0)) | ((point >= high) & (slope > 0.0)))
    move = np.zeros(2)
    if free.any():
        inner = bend[np.ix_(free, free)]
        curved = np.linalg.eigvalsh(inner)
        # what is flat or hollow goes uphill as if it were curved downwards by as much as anything
        inner = inner if curved.max() < 0.0 else -max(float(np.abs(curved).max()), 1e-9) * np.eye(len(inner))
        move[free] = np.clip(np.linalg.solve(inner, -slope[free]), -0.5, 0.5)
    return move


#: With less damping there are thousands of nearly equal swings to compare, and with none there is no largest one.
_LEAST_DAMPING = 1e-4


@dataclass(frozen=True)
class MaximumStress:
    """Where and when the tooth is stressed most after an impact.

    Attributes:
        stress: |sigma_b| of the outer fibre [Pa].
        position: xi = x / length [-], 0 at the root, 1 at the tip.
        time: since the impact [s].
        coefficient: C = stress / (v_I sqrt(rho E)) [-]; for beams of one shape it depends only on the damping ratio,
            the number of modes and their scaling.
    """

    stress: float
    position: float
    time: float
    coefficient: float


def maximum_stress(
    tooth: Beam, material: Material, impact_velocity: float, modes: tuple[Mode, ...] | None = None
) -> MaximumStress:
    """Largest |sigma_b| of `bending_stress` over length and time: 1e-10 relative, its position to 1e-5.

    The stress is proportional to the velocity, so the search is made once for a tooth and a material and then
    remembered; a further impact on the same tooth costs microseconds. At velocity 0 the stress is 0, and position,
    time and coefficient are those of every other velocity.

    Args:
        tooth: the beam.
        material: what it is made of; here its damping ratio must be 1e-4 or more.
        impact_velocity: |v_I| [m/s], >= 0: the tooth's length times the jump of the wheel's rate in the impact,
            l |omega_after - omega_before|. A turning tooth does not vibrate, only the jump of its rotation makes it.
        modes: the modes that take part; without them the two of `ritz_modes`, as in the paper. `converged_modes` give
            the stress of all modes.

    Raises:
        ValueError: when velocity or damping ratio is outside its limits or not a number, or `modes` is empty.

    Source: Pennestrì, Valentini, Vita, eqs (13), (16) and section 5.1.
    """
    require_impact_velocity(impact_velocity)
    found = _of_wedge(tooth, material, modes) if isinstance(tooth, WedgeTooth) else None
    if found is None:
        found = _maximum_at_unit_velocity(tooth, material, modes)
    return replace(found, stress=found.stress * impact_velocity)


def _of_wedge(tooth: WedgeTooth, material: Material, modes: tuple[Mode, ...] | None) -> MaximumStress | None:
    """What one wedge of E = rho = 1 says of all, for the paper's modes and the converged ones; None for others.

    A ~ 1 - xi and I ~ (1 - xi)^3, so that only the scale of time differs. It is l^2 / (h sqrt(E / rho)) with the root's
    height h = l tan(alpha): l / (tan(alpha) sqrt(E / rho)), 1 for the reference wedge.
    """
    unit = Material(1.0, 1.0, material.damping_ratio)
    if modes is None:
        found = _maximum_at_unit_velocity(WEDGE, unit, None)
    elif modes == converged_modes(tooth, material):
        found = _maximum_at_unit_velocity(WEDGE, unit, converged_modes(WEDGE, unit))
    else:
        return None
    slowness = math.sqrt(material.density / material.youngs_modulus)
    return replace(
        found,
        stress=found.coefficient * math.sqrt(material.density * material.youngs_modulus),
        time=found.time * slowness * tooth.length / math.tan(tooth.apex_angle),
    )


@lru_cache(maxsize=1024)
def _maximum_at_unit_velocity(tooth: Beam, material: Material, modes: tuple[Mode, ...] | None) -> MaximumStress:
    advice = "with less, the largest stress comes after very many swings or never"
    require_within("damping ratio", material.damping_ratio, _LEAST_DAMPING, 1.0, "", advice)
    field = BendingField(tooth, material, ritz_modes(tooth, material) if modes is None else modes)
    largest = largest_stress(field)
    return MaximumStress(
        stress=largest.stress,
        position=largest.x / tooth.length,
        time=largest.t,
        coefficient=largest.stress / math.sqrt(material.density * material.youngs_modulus),
    )
