"""Crank and pawl of a ratchet as elastic bars, under forces and impacts on the pawl's tip.

The drive stands still, the crank is a cantilever from its hinge, the pawl hangs on the crank's pin and pushes the wheel
at the root of a tooth, where the tooth itself does not bend.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

Vectors = npt.NDArray[np.float64]

#: Of a uniform bar on a hinge whose inertia balances a force F across its tip, with the bending moment
#: F l x (1 - x) (1 - x / 2) at x l from the tip: the moment's largest value over F l, twice the energy over
#: F^2 l^3 / EI, the tip's deflection from the tangent at the hinge over F l^3 / EI, and the hinge's force over F.
LARGEST_MOMENT, ENERGY, DEFLECTION, HINGE = 1 / math.sqrt(27), 2 / 105, 7 / 120, 1 / 2


@dataclass(frozen=True)
class Bar:
    """A link of rectangular cross section: length l, width w, depth h [m], and flexibility along it, l / EA [m/N]."""

    length: float
    width: float
    depth: float
    axial: float

    @property
    def bending(self) -> float:
        """The l^3 / EI of it [m/N]: three times the flexibility across it, as a cantilever."""
        return 12 * (self.length / self.depth) ** 2 * self.axial

    @property
    def stress(self) -> float:
        """Bending stress by a moment of 1 N m [1/m3]."""
        return 6 / (self.width * self.depth**2)


@dataclass(frozen=True)
class Loaded:
    """What gives way under one load.

    Attributes:
        time: of it [s].
        force: on the face [N].
        pawl_deflection: of its tip, across it [m].
        pawl_stress: by bending [Pa].
        pawl_stretch: along it [m].
        crank_deflection: of its pin, across it [m].
        crank_stress: by bending [Pa].
        motion: by what the wheel turns [rad].
    """

    time: float
    force: float
    pawl_deflection: float
    pawl_stress: float
    pawl_stretch: float
    crank_deflection: float
    crank_stress: float
    motion: float


class Links:
    """Crank and pawl as bars, and where forces act, from the parameters of the FMU."""

    def __init__(self, values: Mapping[str, float]) -> None:
        self.values = values
        length, depth = values["crank_length"], values["crank_depth"]
        # the FMU gives the crank's stiffness across it: l^3 / 3 EI = (2 l / h)^2 l / EA
        crank = (depth / (2 * length)) ** 2 / values["crank_stiffness"]
        self.crank = Bar(length, values["crank_width"], depth, crank)
        self.pawl = Bar(values["pawl_length"], values["pawl_width"], values["pawl_depth"], 1 / values["pawl_stiffness"])

    def held(self, results: pd.DataFrame) -> Loaded:
        """Of communication points at which the face pushes, that with the most lost motion.

        The forces act slowly: the pawl is a two-force member. What bends it comes from the FMU.
        """
        angle = _columns(results, "crank_angle", "pawl_angle", "wheel_angle")
        turned = angle[2] - results["tooth_index"].to_numpy() * self.values["tooth_pitch"]
        slope, face = self._normals(turned)
        push = results["contact_force"].to_numpy()
        force = push * face + results["slope_force"].to_numpy() * slope
        stretch, across, motion = self._lost(angle[0], angle[1], turned, force, force)
        worst = int(np.abs(motion).argmax())
        row = results.iloc[worst]
        bent = float(row["pawl_tip_deflection"]), float(row["pawl_bending_stress"])
        return self._loaded(float(row["time"]), push[worst], bent, stretch[worst], across[worst], motion[worst])

    def struck(self, results: pd.DataFrame, impacts: pd.DataFrame) -> Loaded:
        """Of the impacts on a face, that with the largest force.

        The force is that of a linear spring that takes up the energy m v^2 / 2 of the closing motion, F = v sqrt(k m)
        (as in W. Goldsmith, Impact, London 1960). m is the mass that the impact itself shows, impulse over closing
        speed and 1 + e; k is the stiffness of the pawl along the face's normal, without crank and tooth, which would
        make the chain softer, and F smaller. Across the pawl its inertia balances the force, as in a uniform bar.
        The crank takes no more than the closing energy gives: it and the lost motion are those of the chain of pawl and
        crank, a smaller force in the same proportions on both.
        """
        time = impacts["time"].to_numpy()
        angle = [np.interp(time, results["time"], results[f"{body}_angle"]) for body in ("crank", "pawl", "wheel")]
        turned = angle[2] - impacts["tooth"].to_numpy() * self.values["tooth_pitch"]
        _, face = self._normals(turned)
        along, across = _dot(face, _unit(angle[1])), _dot(face, _left(angle[1]))
        flexibility = along**2 * self.pawl.axial + across**2 * ENERGY * self.pawl.bending
        blow = impacts["impulse"].to_numpy() / (1.0 + self.values["restitution"])
        push = np.sqrt(impacts["closing_speed"].to_numpy() * blow / flexibility)
        side = push * across
        hinge = along * _unit(angle[1]) - HINGE * across * _left(angle[1])  # by a force of 1 N
        give = _dot(hinge, _left(angle[0])) ** 2 * self.crank.bending / 3
        give += _dot(hinge, _unit(angle[0])) ** 2 * self.crank.axial
        chain = np.sqrt(impacts["closing_speed"].to_numpy() * blow / (flexibility + give))
        _, shift, motion = self._lost(angle[0], angle[1], turned, chain * face, chain * hinge)
        stretch = push * along * self.pawl.axial
        worst = int(push.argmax())
        bent = (
            float(DEFLECTION * self.pawl.bending * side[worst]),
            float(LARGEST_MOMENT * self.pawl.length * self.pawl.stress * side[worst]),
        )
        return self._loaded(time[worst], push[worst], bent, stretch[worst], shift[worst], motion[worst])

    def _normals(self, turned: Vectors) -> tuple[Vectors, Vectors]:
        """Normals of slope and face of the tooth whose root has these polar angles, shape (2, times) each."""
        slope = self.values["tooth_slope_angle"]
        lean = math.pi - slope - self.values["tooth_apex_angle"] - self.values["tooth_pitch"]
        return _unit(turned + slope - math.pi / 2), _unit(turned - math.pi / 2 - lean)

    def _lost(
        self, phi: Vectors, gamma: Vectors, turned: Vectors, tip: Vectors, pin: Vectors
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Stretch of the pawl and shift of the crank's pin across it [m], and by what the wheel turns [rad].

        The tip stays at the root: r delta t.e = e.(shift of the pin) + stretch of the pawl, with t the way of the root
        and e along the pawl.
        """
        along = _unit(gamma)
        stretch = _dot(tip, along) * self.pawl.axial
        across = _dot(pin, _left(phi)) * self.crank.bending / 3
        shift = across * _left(phi) + _dot(pin, _unit(phi)) * self.crank.axial * _unit(phi)
        lever = self.values["wheel_inner_radius"] * _dot(_left(turned), along)
        return stretch, across, (_dot(shift, along) + stretch) / lever

    def _loaded(
        self, time: float, force: float, bent: tuple[float, float], stretch: float, across: float, motion: float
    ) -> Loaded:
        crank = self.crank
        stress = 3 * across / crank.bending * crank.length * crank.stress
        return Loaded(float(time), float(force), *bent, float(stretch), float(across), float(stress), float(motion))


def _columns(table: pd.DataFrame, *names: str) -> list[Vectors]:
    return [table[name].to_numpy(dtype=np.float64) for name in names]


def _unit(angle: Vectors) -> Vectors:
    return np.array([np.cos(angle), np.sin(angle)])


def _left(angle: Vectors) -> Vectors:
    return np.array([-np.sin(angle), np.cos(angle)])


def _dot(a: Vectors, b: Vectors) -> Vectors:
    return np.asarray((a * b).sum(axis=0))
