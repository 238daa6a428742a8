"""Free bodies that touch each other and the ground at random points, and what the laws of contact ask of them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from mechanism_fmu.model import GROUND, Body, Force, Mechanism, Output, PointLineContact, Torque

Array = np.ndarray[Any, Any]


class Touching(NamedTuple):
    """A mechanism whose contacts all have gap 0 at the start, and the same in numbers.

    `masses`, `loads` and `rates`, shape (3 bodies,); `rows` are the gradients of the gaps, shape (contacts, 3 bodies);
    `slips` those of the slip of body_i along the line's direction, likewise.
    """

    mechanism: Mechanism
    masses: Array
    loads: Array
    rates: Array
    rows: Array
    slips: Array


def touching(
    seed: int,
    *,
    bodies: int,
    contacts: int,
    moving: bool = False,
    restitution: float | None = None,
    friction: float = 0,
) -> Touching:
    """Random masses, places, forces, contact points and normals; restitutions at random when None."""
    random = np.random.default_rng(seed)
    masses = random.uniform(0.3, 3.0, (bodies, 2))
    frames = [*random.uniform(-1, 1, (bodies, 3)), np.zeros(3)]
    loads = random.uniform(-5, 5, (bodies, 3))
    rates = random.uniform(-1, 1, (bodies, 3)) if moving else np.zeros((bodies, 3))
    names = [*(f"body{b}" for b in range(bodies)), GROUND]
    parts, rows, slips = [], [], []
    for c in range(contacts):
        i, j = random.permutation(bodies + 1)[:2]
        part, both = _contact(
            random, f"contact{c}", (names[i], frames[i]), (names[j], frames[j]), restitution, friction
        )
        parts.append(part)
        for row, of in zip(both, (rows, slips), strict=True):
            full = np.zeros(3 * bodies + 3)
            full[3 * i : 3 * i + 3], full[3 * j : 3 * j + 3] = row[:3], row[3:]
            of.append(full[:-3])
    mechanism = Mechanism(
        bodies=tuple(
            Body(names[b], *masses[b].tolist(), tuple(frames[b].tolist()), tuple(rates[b].tolist()))
            for b in range(bodies)
        ),
        forces=(
            *(Force(f"force{b}", names[b], tuple(loads[b, :2].tolist())) for b in range(bodies)),
            *(Torque(f"torque{b}", names[b], torque=loads[b, 2].item()) for b in range(bodies)),
        ),
        contacts=tuple(parts),
        outputs=(
            *(Output(f"contact{c}", f"contact{c}.force", "") for c in range(contacts)),
            *(Output(name, f"energy.{name}", "") for name in ("kinetic", "lost")),
        ),
    )
    repeated = np.repeat(masses, [2, 1], axis=1).ravel()
    return Touching(mechanism, repeated, loads.ravel(), rates.ravel(), np.array(rows), np.array(slips))


def _contact(random: Any, name: str, i: Any, j: Any, restitution: float | None, friction: float) -> Any:
    """A contact between two (name, frame), and its two rows, of gap and slip, in their six coordinates."""
    (body_i, (xi, yi, phi)), (body_j, (xj, yj, psi)) = i, j
    px, py = random.uniform(-0.8, 0.8, 2)
    direction = random.uniform(-math.pi, math.pi)
    nx, ny = math.cos(direction), math.sin(direction)
    ax, ay = math.cos(phi) * px - math.sin(phi) * py, math.sin(phi) * px + math.cos(phi) * py
    ex, ey = xi + ax - xj, yi + ay - yj
    contact = PointLineContact(
        name,
        body_i,
        (px, py),
        body_j,
        (math.cos(psi) * ex + math.sin(psi) * ey, math.cos(psi) * ey - math.sin(psi) * ex),
        (math.cos(direction - psi), math.sin(direction - psi)),
        restitution=random.uniform(0, 1) if restitution is None else restitution,
        friction=friction,
    )
    # the gap's rate is the normal part of the difference of two velocities of material points
    return contact, [[x, y, y * ax - x * ay, -x, -y, x * ey - y * ex] for x, y in ((nx, ny), (ny, -nx))]
