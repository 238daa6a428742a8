"""A cycle of the four-bar path generator that bends, against a frame by direct stiffness at one angle after another."""

from __future__ import annotations

import numpy as np

from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static
from mechanism_fmu.elastodynamics.elements import FloatArray
from mechanism_fmu.kinematics import KinematicMotion, analyse

from .path_generator import PathGenerator
from .timing import Comparison, batch, in_turns, require_agreement

_ANGLES = 361
#: A cycle must take less [s].
_LONGEST = 0.02
#: The two differ by less [m, rad].
_WITHIN = 1e-12


def compare(rounds: int) -> list[Comparison]:
    """Case 2 over a cycle, each degree: deflections, from the rigid motion on; ours with stresses and reactions."""
    generator = PathGenerator()
    mechanism = generator.mechanism()
    motion = analyse(mechanism, np.linspace(0.0, 2 * np.pi / generator.speed, _ANGLES))

    def ours() -> FloatArray:
        return quasi_static(configurations(linkage(mechanism), motion)).deflection("arm.end")

    def plain() -> FloatArray:
        return np.array([_by_stiffness(generator, motion, k) for k in range(_ANGLES)])

    require_agreement("A cycle of the path generator", plain(), ours(), _WITHIN)
    slow, fast = in_turns(lambda: batch(plain, 1), lambda: batch(ours, 1), rounds)
    return [Comparison("an elastic cycle", f"four-bar path generator, {_ANGLES} angles", slow, fast, longest=_LONGEST)]


def _by_stiffness(generator: PathGenerator, motion: KinematicMotion, k: int) -> FloatArray:
    """(delta_x, delta_y, rotation) of the path point at one angle: bars of 6x6 matrices, with a hinge at each pin."""
    turns = [motion.of(f"{body}.angle") for body in ("crank", "coupler", "follower")]
    crank, coupler, follower = ((angle[k], rate[k], acceleration[k]) for angle, rate, acceleration in turns)
    pin = _relative(generator.crank, *crank)
    path = pin + _relative(generator.arm, coupler[0] + generator.angle, *coupler[1:])
    end = _relative(generator.follower, *follower)
    # Unknowns: crank pin (x, y, of the crank, of the coupler), path point (x, y, angle), follower pin (x, y, of the
    # coupler, of the follower), and the follower's rotation at its hinge; what is negative does not move.
    bars = (
        (generator.crank, crank[0], (-1, -1, -1, 0, 1, 2)),
        (generator.coupler, coupler[0], (0, 1, 3, 7, 8, 9)),
        (generator.arm, coupler[0] + generator.angle, (0, 1, 3, 4, 5, 6)),
        (generator.follower, follower[0], (-1, -1, 11, 7, 8, 10)),
    )
    stiffness, masses = np.zeros((12, 12)), np.zeros(12)
    for length, angle, places in bars:
        numbers = [place for place in places if place >= 0]
        kept = [row for row, place in enumerate(places) if place >= 0]
        stiffness[np.ix_(numbers, numbers)] += _bar(generator, length, angle)[np.ix_(kept, kept)]
        for first in (0, 3):
            if places[first] >= 0:
                masses[[*places[first : first + 2]]] += generator.density * generator.section.area * length / 2
    for (mass, inertia), (x, y, angle_place) in zip(generator.disks, ((4, 5, 6), (0, 1, 3), (7, 8, 9)), strict=True):
        masses[[x, y]] += mass
        masses[angle_place] += inertia
    accelerations = np.zeros(12)
    accelerations[[0, 1]], accelerations[[4, 5]], accelerations[[7, 8]] = pin, path, end
    accelerations[[3, 6]] = coupler[2]
    return np.asarray(np.linalg.solve(stiffness, -masses * accelerations)[4:7], dtype=np.float64)


def _relative(length: float, angle: float, rate: float, acceleration: float) -> FloatArray:
    """The acceleration of the end of a link whose beginning rests [m/s2]."""
    c, s = np.cos(angle), np.sin(angle)
    return length * np.array([-acceleration * s - rate**2 * c, acceleration * c - rate**2 * s])


def _bar(generator: PathGenerator, length: float, angle: float) -> FloatArray:
    """Stiffness matrix of a bar for (x, y, rotation) of both ends, shape (6, 6)."""
    axial = generator.young * generator.section.area / length
    bending = generator.young * generator.section.second_moment / length**3
    side, corner, turn = 12 * bending, 6 * bending * length, 4 * bending * length**2
    local = np.array(
        [
            [axial, 0, 0, -axial, 0, 0],
            [0, side, corner, 0, -side, corner],
            [0, corner, turn, 0, -corner, turn / 2],
            [-axial, 0, 0, axial, 0, 0],
            [0, -side, -corner, 0, side, -corner],
            [0, corner, turn / 2, 0, -corner, turn],
        ]
    )
    c, s = np.cos(angle), np.sin(angle)
    turned = np.kron(np.eye(2), np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]]))
    matrix: FloatArray = turned.T @ local @ turned
    return matrix
