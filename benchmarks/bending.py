"""A linkage that bends: a cycle of Case 2, and the periodic solution of Case 3."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static
from mechanism_fmu.elastodynamics.cycle import Cycle
from mechanism_fmu.elastodynamics.dynamics import deflection_of, elastic_cycle
from mechanism_fmu.elastodynamics.periodic import periodic_response
from mechanism_fmu.elastodynamics.transient import transient
from mechanism_fmu.kinematics import analyse

from . import bending_by_hand
from .path_generator import INCH, PathGenerator
from .timing import Comparison, batch, in_turns, require_agreement

_LONGEST_CYCLE, _LONGEST_PERIODIC = 20e-3, 2.0
_CYCLES = 10
#: Twelve turns with 2 % of damping forget the start to 1e-6 of itself.
_TURNS, _STEPS = 12, 2880
_WITHIN_STATIC, _WITHIN_PERIODIC = 1e-9, 5e-6


def compare(rounds: int) -> list[Comparison]:
    """Compare both for the paper's path generator at 500 rpm, one turn at 1 deg."""
    generator = PathGenerator()
    mechanism = generator.mechanism()
    motion = analyse(mechanism, np.linspace(0.0, 2 * math.pi / generator.speed, 361))
    structure = linkage(mechanism)

    def cycle() -> Cycle:
        return quasi_static(configurations(structure, motion))

    found = cycle()
    by_hand = bending_by_hand.cycle(500, 360).static()[:, :2] * INCH
    require_agreement("A cycle of Case 2 [m]", by_hand, found.deflection("arm.end")[:-1, :2], _WITHIN_STATIC)
    swinging = elastic_cycle(found, 0.02)
    slowly = transient(swinging, _STEPS, _TURNS).displacement[-_STEPS - 1 :: _STEPS // 360]
    at_once = periodic_response(swinging).samples(360)
    path = [deflection_of(found.configurations, u, "arm.end")[:-1] for u in (slowly, np.vstack([at_once, at_once[:1]]))]
    require_agreement("The periodic motion [m, rad]", path[0], path[1], _WITHIN_PERIODIC)
    return [
        Comparison(
            "a cycle of Case 2 at 1 deg",
            "by hand, angle by angle",
            *in_turns(lambda: batch(_by_hand, 1), lambda: batch(cycle, _CYCLES), rounds),
            longest=_LONGEST_CYCLE,
        ),
        Comparison(
            "the periodic motion at 500 rpm",
            f"direct integration of {_TURNS} turns",
            *in_turns(
                lambda: batch(lambda: transient(swinging, _STEPS, _TURNS), 1),
                lambda: batch(lambda: periodic_response(swinging), 1),
                rounds,
            ),
            longest=_LONGEST_PERIODIC,
        ),
    ]


def _by_hand() -> object:
    """Deflections of Case 2 as an engineer would program the paper's equations."""
    angles = np.asarray(2 * math.pi / 360 * np.arange(360))
    load = -bending_by_hand.accelerations(angles, 500 * math.pi / 30) @ bending_by_hand.masses()
    flexibility, found = bending_by_hand.flexibility(), []
    for angle, forces in zip(angles, load, strict=True):
        transfer = bending_by_hand.transfer(angle)
        found.append(transfer.T @ (flexibility @ (transfer @ forces)))
    return found
