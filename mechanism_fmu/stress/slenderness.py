"""Whether a tooth is slender enough for beam theory."""

from __future__ import annotations

import numpy as np

from .beam import Beam

#: Least length over root height. Shear adds 3 E I / (kappa G A l^2) = 0.78 (h / l)^2 to what bending alone deflects a
#: uniform cantilever under a force at its tip (Poisson's ratio 0.3, kappa = 5/6): 3 % at 5, but 280 % at 0.53.
LEAST_SLENDERNESS = 5.0


def slenderness(beam: Beam) -> float:
    """Length over height at the root [-]; the height is twice the distance of the outer fibre.

    Raises:
        ValueError: when the beam has no height at its root.
    """
    height = 2 * float(beam.outer_fibre(np.array([0.0]))[0])
    if not height > 0:
        raise ValueError(
            f"the beam is {height:g} m high at its root, but a root that holds it has a height: turn it round."
        )
    return beam.length / height


def beam_theory_note(beam: Beam) -> str:
    """One sentence: length over root height, and whether beam theory covers such a beam.

    The limit, 5, is for the first mode and the static deflection. The n-th mode bends over about l / n, so fast modes
    leave the theory of Euler and Bernoulli at larger ratios already.

    Raises:
        ValueError: as of `slenderness`.

    Source: S. P. Timoshenko, J. M. Gere, Mechanics of Materials, section on deflections by shear.
    """
    ratio = f"Length over root height is {slenderness(beam):.3g}"
    if slenderness(beam) >= LEAST_SLENDERNESS:
        return f"{ratio}, within beam theory ({LEAST_SLENDERNESS:g} or more)."
    return (
        f"{ratio}, outside beam theory ({LEAST_SLENDERNESS:g} or more): the stress compares teeth of one shape, but "
        "is not that of the real tooth."
    )
