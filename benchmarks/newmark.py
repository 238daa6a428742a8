"""How a bending linkage swings in from any state, by direct integration: the other way to its periodic motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from mechanism_fmu.elastodynamics import ElasticCycle

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Transient:
    """Deviation over some periods.

    Attributes:
        time: shape (steps + 1,) [s], from 0.
        displacement, velocity, acceleration: shape (steps + 1, n).
    """

    time: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    acceleration: FloatArray


def transient(
    cycle: ElasticCycle,
    steps: int,
    periods: int = 1,
    displacement: FloatArray | None = None,
    velocity: FloatArray | None = None,
) -> Transient:
    """Integrate M u'' + C u' + K(t) u = p by Newmark's average acceleration: of second order, stable at any step.

    Args:
        cycle: the equations.
        steps: of one period. The shortest natural period that matters should have 20 of them.
        periods: how many.
        displacement: u at t = 0, shape (n,); zero unless told.
        velocity: u' at t = 0, shape (n,); zero unless told.

    Raises:
        ValueError: there are no steps or periods, or M is singular, so that there is no acceleration to begin with.

    Source: N. M. Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85 (1959), with
        beta = 1/4 and gamma = 1/2.
    """
    if steps < 1 or periods < 1:
        raise ValueError(f"{steps} steps of each of {periods} periods: there must be one or more of either.")
    u, v = (
        np.zeros(cycle.load.shape[1]) if x is None else np.asarray(x, dtype=float) for x in (displacement, velocity)
    )
    found = _integrated(cycle.resampled(steps), periods, u, v)
    time = np.asarray(cycle.period / steps * np.arange(periods * steps + 1))
    return Transient(time, *found)


def _integrated(
    here: ElasticCycle, periods: int, u: FloatArray, v: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """u, v and a at all times."""
    h, load = here.period / here.samples, here.load
    effective = np.linalg.inv(4.0 / h**2 * here.mass + 2.0 / h * here.damping + here.stiffness)
    try:
        a = np.linalg.solve(here.mass[0], load[0] - here.damping[0] @ v - here.stiffness[0] @ u)
    except np.linalg.LinAlgError as error:
        raise ValueError(
            "a coordinate has no mass, so its acceleration is not known: give it one, or take the periodic response."
        ) from error
    count = periods * here.samples + 1
    states = tuple(np.empty((count, *u.shape)) for _ in range(3))
    for k in range(count):
        if k > 0:
            j = k % here.samples
            from_u, from_v = 4.0 / h**2 * u + 4.0 / h * v + a, 2.0 / h * u + v
            new = effective[j] @ (load[j] + here.mass[j] @ from_u + here.damping[j] @ from_v)
            u, v, a = new, 2.0 / h * new - from_v, 4.0 / h**2 * new - from_u
        for kept, value in zip(states, (u, v, a), strict=True):
            kept[k] = value
    return states[0], states[1], states[2]
