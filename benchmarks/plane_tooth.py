"""A triangular tooth as a plate of finite elements (scikit-fem) in plane stress, clamped at its root.

It measures what the paper's beam leaves out. E = rho = 1 and unit thickness: a ratio to the beam of the same size holds
for every size, modulus and density; Poisson's ratio alone matters.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.sparse.linalg import LinearOperator, eigsh, splu
from skfem import Basis, BilinearForm, ElementTriP4, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, dot, eye, sym_grad, trace

from mechanism_fmu.stress import WedgeTooth

FloatArray = npt.NDArray[np.float64]

POISSON = 0.3

#: Halvings of the elements at the root's corners, where a clamped edge meets a free one and the stress is singular.
_HALVINGS = 10
#: Inwards from the flank, so that a place on it lies in an element in spite of rounding.
_INWARDS = 1e-9


@dataclass(frozen=True)
class Plate:
    """A triangle in the axes of the paper's beam: x along the face from the beam's root, y across it to the slope.

    Attributes:
        face_root, apex, slope_root: its corners (x, y) [m]; the edge between the two of the root is clamped.
        length: l of the beam [m]: the apex lies at (l, 0).
    """

    face_root: tuple[float, float]
    apex: tuple[float, float]
    slope_root: tuple[float, float]
    length: float


@dataclass(frozen=True)
class PlateSolution:
    """What finite elements find, with E = rho = 1.

    Attributes:
        unknowns: number of displacements.
        frequency: first natural frequency [rad/s].
        static: stress along face and slope, shape (2, places), under a body force x / l across the beam.
        impact: the same for the first mode alone, undamped, at its largest, when the tooth starts with the velocity
            x / l across the beam.
    """

    unknowns: int
    frequency: float
    static: FloatArray
    impact: FloatArray


def wedge_plate(tooth: WedgeTooth) -> Plate:
    """The paper's right-angled triangle, eq (14), clamped where the beam is."""
    height = tooth.length * math.tan(tooth.apex_angle)
    return Plate((0.0, 0.0), (tooth.length, 0.0), (0.0, height), tooth.length)


def whole_plate(tooth: WedgeTooth, face: float, slope: float) -> Plate:
    """The tooth as it is cut: the triangle of root, apex and next root, clamped on the chord between the roots.

    Args:
        tooth: the wedge that stands for it.
        face: F, from the apex to the root on its side [m].
        slope: L, from the apex to the other root [m].
    """
    next_root = (tooth.length - slope * math.cos(tooth.apex_angle), slope * math.sin(tooth.apex_angle))
    return Plate((tooth.length - face, 0.0), (tooth.length, 0.0), next_root, tooth.length)


def solve(plate: Plate, refinement: int, places: Sequence[float]) -> PlateSolution:
    """First mode, and the stress along both flanks.

    Elements have polynomials of degree 4. The mesh of a refinement halves all elements of the one before, so that
    frequencies fall from mesh to mesh towards the exact one.

    Args:
        plate: the tooth.
        refinement: of the mesh, 0 or more; each makes four elements of one.
        places: x / l on the flanks where the stress is asked for, between root and apex.
    """
    mesh = _mesh(plate, refinement)
    basis = Basis(mesh, ElementVector(ElementTriP4()))
    stiffness, mass = BilinearForm(_stiffness).assemble(basis), BilinearForm(_mass).assemble(basis)
    load = LinearForm(_load).assemble(basis, length=plate.length)
    free = np.setdiff1d(np.arange(basis.N), basis.get_dofs("root").all())
    stiffness, mass, load = stiffness[free][:, free].tocsc(), mass[free][:, free].tocsc(), load[free]
    inverse = splu(stiffness)
    operator = LinearOperator(stiffness.shape, inverse.solve, dtype=float)
    start = np.ones(len(free))  # else a random one, and the last digits with it
    squares, modes = eigsh(stiffness, 1, mass, sigma=0.0, OPinv=operator, v0=start)
    frequency, mode = math.sqrt(squares[0]), modes[:, 0]
    # rho = 1: the body force x / l is also the mass matrix times the velocity x / l
    amplitude = (mode @ load) / (mode @ (mass @ mode)) / frequency

    def stress(displacement: FloatArray) -> FloatArray:
        everywhere = np.zeros(basis.N)
        everywhere[free] = displacement
        return np.array(
            [
                _flank_stress(basis, everywhere, plate, root, places)
                for root in (np.array(plate.face_root), np.array(plate.slope_root))
            ]
        )

    return PlateSolution(len(free), frequency, stress(inverse.solve(load)), stress(amplitude * mode))


def _mesh(plate: Plate, refinement: int) -> Any:
    corners = np.array([plate.face_root, plate.apex, plate.slope_root]).T
    mesh = _strips(corners)
    for _ in range(_HALVINGS):
        nearest = [np.argmin(np.hypot(*(mesh.p - corners[:, [corner]]))) for corner in (0, 2)]
        mesh = mesh.refined(np.nonzero(np.isin(mesh.t, nearest).any(axis=0))[0])
    along = corners[:, 2] - corners[:, 0]
    across = np.array([-along[1], along[0]]) / (along @ along)

    def on_root(x: FloatArray) -> npt.NDArray[np.bool_]:
        return np.asarray(np.abs(across[0] * (x[0] - corners[0, 0]) + across[1] * (x[1] - corners[1, 0])) < 1e-9)

    return mesh.refined(refinement).with_boundaries({"root": on_root})


def _strips(corners: FloatArray) -> Any:
    """Two right-angled triangles, by the height over the slope, the one at the root in strips about as wide as high.

    A tooth of small slope is much longer along the root than high; elements of that shape would be poor.
    """
    face_root, apex, slope_root = corners.T
    along = slope_root - apex
    foot = apex + along * ((face_root - apex) @ along) / (along @ along)
    number = max(2, round(np.hypot(*(slope_root - foot)) / np.hypot(*(face_root - foot))))
    towards = np.arange(number)[:, None] / number
    ends = [start * (1 - towards) + slope_root * towards for start in (face_root, foot)]
    lower, last = np.arange(number - 1), 2 * number
    upper = number + lower
    strips = [np.array([lower, upper, lower + 1]), np.array([lower + 1, upper, upper + 1])]
    tips = np.array([[number - 1, last - 1, last], [0, number, last + 1]]).T
    return MeshTri(np.vstack([*ends, slope_root, apex]).T, np.hstack([*strips, tips]))


def _stiffness(u: Any, v: Any, w: Any) -> Any:
    strain = sym_grad(u)
    stress = POISSON / (1 - POISSON**2) * eye(trace(strain), 2) + strain / (1 + POISSON)
    return ddot(stress, sym_grad(v))


def _mass(u: Any, v: Any, w: Any) -> Any:
    return dot(u, v)


def _load(v: Any, w: Any) -> Any:
    return w.x[0] / w.length * v[1]


def _flank_stress(
    basis: Any, displacement: FloatArray, plate: Plate, root: FloatArray, places: Sequence[float]
) -> list[float]:
    """The stress along a free edge, which is its only one: Young's modulus, here 1, times the strain along it."""
    apex = np.array(plate.apex)
    direction = (apex - root) / np.hypot(*(apex - root))
    inside = (np.array(plate.face_root) + apex + np.array(plate.slope_root)) / 3
    find, mapping = basis.mesh.element_finder(), basis.mesh.mapping()
    found = []
    for place in places:
        on_flank = root + direction * (place * plate.length - root[0]) / direction[0]
        point = on_flank + _INWARDS * (inside - on_flank)
        cell = find(point[:1], point[1:])
        local = mapping.invF(point.reshape(2, 1, 1), tind=cell)[:, 0, :]
        at_point = Basis(basis.mesh, basis.elem, elements=cell, quadrature=(local, np.ones(1)))
        found.append(float(direction @ at_point.interpolate(displacement).grad[:, :, 0, 0] @ direction))
    return found
