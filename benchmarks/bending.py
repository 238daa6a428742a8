"""A linkage that swings: its periodic motion at once, against direct integration until it has settled."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static
from mechanism_fmu.elastodynamics.elastic_cycle import deflection_of, elastic_cycle
from mechanism_fmu.elastodynamics.responses import periodic_response
from mechanism_fmu.kinematics import analyse

from .newmark import transient
from .path_generator import PathGenerator
from .timing import Comparison, batch, in_turns, require_agreement

_LONGEST = 2.0
#: Twelve turns with 2 % of damping forget the start to 1e-6 of itself.
_TURNS, _STEPS = 12, 2880
_WITHIN = 5e-6


def compare(rounds: int) -> list[Comparison]:
    """Compare the steady state of the path generator at 500 rpm, with 2 % of damping."""
    generator = PathGenerator()
    mechanism = generator.mechanism()
    motion = analyse(mechanism, np.linspace(0.0, 2 * math.pi / generator.speed, 361))
    found = quasi_static(configurations(linkage(mechanism), motion))
    swinging = elastic_cycle(found, 0.02)
    slowly = transient(swinging, _STEPS, _TURNS).displacement[-_STEPS - 1 :: _STEPS // 360]
    at_once = periodic_response(swinging).samples(360)
    path = [deflection_of(found.configurations, u, "arm.end")[:-1] for u in (slowly, np.vstack([at_once, at_once[:1]]))]
    require_agreement("The periodic motion [m, rad]", path[0], path[1], _WITHIN)
    return [
        Comparison(
            "the periodic motion at 500 rpm",
            f"direct integration of {_TURNS} turns",
            *in_turns(
                lambda: batch(lambda: transient(swinging, _STEPS, _TURNS), 1),
                lambda: batch(lambda: periodic_response(swinging), 1),
                rounds,
            ),
            longest=_LONGEST,
        ),
    ]
