"""The structure in all configurations of a motion: compatibility d = C u, f = B P, flexibility and stiffness."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...kinematics import KinematicMotion
from ..elements import FloatArray, LinkageError, block_diagonal
from .compatibility import constraint_rows, guided, independent_basis
from .linkage import Linkage
from .places import RELEASED, named_place
from .pose import Pose, left, pose_of

# How system forces become element forces: f = B P, from compatibility d = C u by virtual work, B = C^-T.

#: A configuration is refused where errors of the geometry come out this much larger in the forces.
_WORST_CONDITION = 1e10


def transfer_matrix(
    compatibility: FloatArray,
    flexibility: FloatArray,
    time: FloatArray,
    coordinates: tuple[str, ...],
    scale: FloatArray,
) -> FloatArray:
    """B, shape (times, n, m).

    Virtual work, P.u = f.d for all u, is C^T f = P: as many equations as displacements. With n = m, B = C^-T. With
    n > m the linkage is statically indeterminate, and f = B_0 P + B_1 X with C^T B_0 = 1 and C^T B_1 = 0: the n - m
    redundants X are those that leave no gap, B_1^T F f = 0.

    Args:
        compatibility: C, shape (times, n, m).
        flexibility: F, shape (n, n).
        time: of the configurations, shape (times,) [s], for messages.
        coordinates: names of the m displacements, for messages.
        scale: what makes lengths of the m displacements, shape (m,): 1, and a length [m] where they are rotations.

    Raises:
        LinkageError: the linkage can move although its driven or held coordinates stand still, always or in one
            configuration; the message says what moves.
    """
    n, m = compatibility.shape[1:]
    if n < m:
        raise LinkageError(
            f"{m} displacements are free, but members resist in {n} ways only: "
            f"{_moving(compatibility[0], coordinates)} can move although driven or held coordinates stand still. "
            "Hold or drive one more, or give a body members."
        )
    transfer = _inverse(compatibility) if n == m else _with_redundants(compatibility, flexibility)
    condition = np.linalg.norm(compatibility / scale, axis=(1, 2)) * np.linalg.norm(transfer * scale, axis=(1, 2))
    worst = int(np.argmax(np.where(np.isfinite(condition), condition, np.inf)))
    if not condition[worst] < _WORST_CONDITION:
        raise LinkageError(
            f"At t = {time[worst]:.9g} s members hold nothing: {_moving(compatibility[worst], coordinates)} can move "
            "although driven or held coordinates stand still (a toggle position, or a part that hangs on one pin). "
            "Leave this position out, or hold or drive what moves."
        )
    return transfer


def _inverse(compatibility: FloatArray) -> FloatArray:
    try:
        return np.swapaxes(np.linalg.inv(compatibility), 1, 2)
    except np.linalg.LinAlgError:
        singular: FloatArray = np.full_like(compatibility, np.nan)
        regular = np.linalg.matrix_rank(compatibility) == compatibility.shape[1]
        singular[regular] = np.swapaxes(np.linalg.inv(compatibility[regular]), 1, 2)
        return singular


def _with_redundants(compatibility: FloatArray, flexibility: FloatArray) -> FloatArray:
    m = compatibility.shape[2]
    orthogonal, triangle = np.linalg.qr(compatibility, mode="complete")
    first, redundant = orthogonal[:, :, :m], orthogonal[:, :, m:]
    try:
        statics = first @ np.swapaxes(np.linalg.inv(triangle[:, :m]), 1, 2)
    except np.linalg.LinAlgError:
        return np.full_like(compatibility, np.nan)
    gaps = np.swapaxes(redundant, 1, 2) @ flexibility
    closing: FloatArray = statics - redundant @ np.linalg.solve(gaps @ redundant, gaps @ statics)
    return closing


def _moving(compatibility: FloatArray, coordinates: tuple[str, ...]) -> str:
    """The displacements with the largest part in what deforms no member, as a list of names."""
    free = np.linalg.svd(compatibility, full_matrices=True)[2][-1]
    shares = np.abs(free) / np.abs(free).max()
    return ", ".join(coordinates[k] for k in np.argsort(-shares)[:4] if shares[k] > 1e-3)


@dataclass(frozen=True)
class Configurations:
    """A linkage along a motion. All matrices come for all configurations, shape (times, ...).

    Attributes:
        linkage: it.
        pose: of its bodies.
        coordinates: names of the m free displacements u, "<place>.x|y|angle", or "<place>.along" a guide.
        basis: Z of w = Z u, shape (times, unknowns, m), or (1, unknowns, m) where it is always the same.

    Source: `configurations`: compatibility, docs/decisions/022-elastodynamics.md.
    """

    linkage: Linkage
    pose: Pose
    coordinates: tuple[str, ...]
    basis: FloatArray

    @cached_property
    def ends(self) -> FloatArray:
        """E of e = E u, shape (times, elements, 6, m): how the ends of each element are displaced.

        (u, v, theta) of its start and of its end, along the element and to its left [m, m, rad]. A rotation that is no
        unknown follows from the others of the element: no moment acts there.
        """
        freedoms = self.linkage.freedoms
        wide = np.zeros((len(self.pose.time), len(self.linkage.elements), 6, freedoms.ground + 1))
        for number, element in enumerate(self.linkage.elements):
            along = _direction(self.pose, element.member.body, element.member.start, element.member.end)
            part = wide[:, number]
            for place, first in ((element.start, 0), (element.end, 3)):
                x, y, angle = freedoms.columns[place]
                part[:, first, [x, y]] += along
                part[:, first + 1, [x, y]] += left(along)
                if angle != RELEASED:
                    part[:, first + 2, angle] = 1.0
            chord = (part[:, 4] - part[:, 1]) / element.length
            known = [freedoms.columns[place, 2] != RELEASED for place in (element.start, element.end)]
            for here, there in ((0, 1), (1, 0)):
                if not known[here]:
                    part[:, 3 * here + 2] = 1.5 * chord - 0.5 * part[:, 3 * there + 2] if known[there] else chord
        return self._reduced(wide[..., :-1])

    @cached_property
    def compatibility(self) -> FloatArray:
        """C of d = C u, shape (times, n, m): element deformations from the free displacements."""
        deformation = block_diagonal(element.deformation for element in self.linkage.elements)
        ends = self.ends
        return deformation @ ends.reshape(len(ends), -1, ends.shape[-1])

    @cached_property
    def transfer(self) -> FloatArray:
        """B of f = B P, shape (times, n, m): element forces from system forces along the free displacements; eq (11).

        Raises:
            LinkageError: the linkage can move although it should stand still.
        """
        longest = max(element.length for element in self.linkage.elements)
        scale = np.where([name.endswith(".angle") for name in self.coordinates], longest, 1.0)
        return transfer_matrix(self.compatibility, self.linkage.flexibility, self.pose.time, self.coordinates, scale)

    @cached_property
    def system_flexibility(self) -> FloatArray:
        """B^T F B, shape (times, m, m): u = (B^T F B) P; eq (10)."""
        transfer = self.transfer
        flexibility: FloatArray = np.swapaxes(transfer, 1, 2) @ (self.linkage.flexibility @ transfer)
        return flexibility

    @cached_property
    def stiffness(self) -> FloatArray:
        """K = C^T F^-1 C, shape (times, m, m): P = K u. The inverse of `system_flexibility`."""
        compatibility = self.compatibility
        stiffness: FloatArray = np.swapaxes(compatibility, 1, 2) @ np.linalg.solve(
            self.linkage.flexibility, compatibility
        )
        return stiffness

    def displacement(self, place: str) -> FloatArray:
        """Rows that give (u_x, u_y, theta) of a place [m, m, rad] from u, shape (times or 1, 3, m).

        A rotation that is no unknown is that of the end of the member of this name.

        Args:
            place: its name, e.g. "arm.end".

        Raises:
            LinkageError: there is no such place.
        """
        freedoms = self.linkage.freedoms
        columns = freedoms.columns[named_place(freedoms.places, place)]
        wide = np.zeros((1, 3, freedoms.ground + 1))
        for row, column in enumerate(columns):
            if column != RELEASED:
                wide[0, row, column] = 1.0
        rows = self._reduced(wide[..., :-1])
        if columns[2] != RELEASED:
            return rows
        member, _, end = place.rpartition(".")
        number = [element.member.name for element in self.linkage.elements].index(member)
        turned = self.ends[:, number, 2 if end == "start" else 5]
        wider = np.broadcast_to(rows, (len(turned), *rows.shape[1:])).copy()
        wider[:, 2] = turned
        return wider

    def _reduced(self, wide: FloatArray) -> FloatArray:
        """Rows for u from rows for w, shape (times, ..., unknowns)."""
        if self.basis.shape[1] == self.basis.shape[2]:
            return wide  # w = u
        flat = wide.reshape(len(wide), -1, wide.shape[-1]) @ self.basis
        return flat.reshape(len(flat), *wide.shape[1:-1], flat.shape[-1])


def configurations(linkage: Linkage, motion: KinematicMotion) -> Configurations:
    """A linkage in every configuration of a motion of its mechanism.

    Args:
        linkage: the structure.
        motion: of its mechanism, as `analyse` gives it.

    Raises:
        LinkageError: the motion is another mechanism's, a joint is of a kind that the flexibility approach does not
            know, or what rigid bodies are held by says the same twice.

    Source: Erdman, Sandor, Oakberg (1972), eqs (10) to (12), with B from compatibility:
        docs/decisions/022-elastodynamics.md.
    """
    pose = pose_of(linkage.mechanism, motion)
    rows, owners = constraint_rows(linkage.mechanism, linkage.freedoms, pose)
    guides = guided(linkage.mechanism, linkage.freedoms, pose)
    basis, names = independent_basis(rows, owners, linkage.freedoms.names, guides)
    return Configurations(linkage, pose, names, basis)


def _direction(pose: Pose, body: str, start: tuple[float, float], end: tuple[float, float]) -> FloatArray:
    along = pose.turned(body, (end[0] - start[0], end[1] - start[1]))
    return along / np.hypot(along[:, 0], along[:, 1])[:, None]
