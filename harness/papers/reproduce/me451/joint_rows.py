"""The joints of the ME451 slides: each one's five steps, by hand and against differences of its own Phi."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Callable, Sequence

import numpy as np

from mechanism_fmu.kinematics import mobility
from mechanism_fmu.kinematics.equations import Equations
from mechanism_fmu.model import (
    Body,
    CamFlatFollower,
    CamFollower,
    Contact,
    Distance,
    Gears,
    InternalGears,
    Mechanism,
    PointFollower,
    RackAndPinion,
    Revolute,
    RevoluteTranslational,
    Translational,
    circle,
    harmonic_profile,
)
from mechanism_fmu.model.joints import Joint

from ..bench import FloatArray, first_derivative, joint_deviations
from ..row import Found, Row, Verdict, judged

# Two bodies placed by hand as each joint of the ME451 slides says, so that its Phi must vanish there.
#
# Each function takes numbers at will, as many as degrees of freedom remain, and returns the coordinates of both bodies
# (and contact angles), from geometry alone: distances, arcs and tangents by differences, without any constraint row.
# Points of the plane are complex numbers.

A, B = 0.3 - 0.2j, -0.25 + 0.4j
#: Distances, radii, marks and directions of the parts, as in `PARTS`.
ROD, OFFSET, ROLLER = 1.1, 0.7, 0.25
GEAR_PAIR, RING, RACK = (0.5, 0.3, 0.9, 3.3), (1.9, 0.3, 0.6, 0.4), (0.2, 0.5, 1.1)
RACK_ORIGIN = A + rect(0.6, 0.2)
AXIS_I, AXIS_J, GUIDE, FACE = (1.0, 0.4), (1.0, 0.3), (0.2, 1.0), (0.3, -1.0)

Free = Sequence[float]


def egg(alpha: float) -> complex:
    """Point of the profile without any symmetry [m]."""
    return rect(1.0 + 0.1 * math.cos(alpha) + 0.05 * math.cos(2 * alpha) + 0.02 * math.sin(alpha), alpha)


def _direction(vector: tuple[float, float]) -> float:
    return math.atan2(vector[1], vector[0])


def _placed(free: Free, point: complex, phi_j: float, on_j: complex, *alphas: float) -> FloatArray:
    """Body i at free[:3], body j turned by phi_j with its point `on_j` at `point`."""
    centre = point - on_j * rect(1.0, phi_j)
    return np.array([*free[:3], centre.real, centre.imag, phi_j, *alphas])


def _on_i(free: Free, point: complex) -> complex:
    return complex(free[0], free[1]) + point * rect(1.0, free[2])


def _revolute(free: Free) -> FloatArray:
    return _placed(free, _on_i(free, A), free[3], B)


def _translational(free: Free) -> FloatArray:
    """Both axes on one line, at any distance along it."""
    axis = free[2] + _direction(AXIS_I)
    return _placed(free, _on_i(free, A) + rect(free[3], axis), axis - _direction(AXIS_J), B)


def _distance(free: Free) -> FloatArray:
    return _placed(free, _on_i(free, A) + rect(ROD, free[3]), free[4], B)


def _revolute_translational(free: Free) -> FloatArray:
    """P_j at c from the axis, any way along it."""
    return _placed(free, _on_i(free, A) + complex(free[3], OFFSET) * rect(1.0, free[2] + _direction(GUIDE)), free[4], B)


def _gears(free: Free) -> FloatArray:
    """Centres R_i + R_j apart; the arcs from the marks to the point of contact are equal."""
    (ri, mark_i, rj, mark_j), line = GEAR_PAIR, free[3]
    arc = ri * (line - (free[2] + mark_i))
    # the contact is on the other side of gear j, and it turns the other way
    return _placed(free, _on_i(free, A) + rect(ri + rj, line), line + math.pi + arc / rj - mark_j, B)


def _ring(free: Free) -> FloatArray:
    """Centres R_i - R_j apart; both marks are on the same side, and both arcs run the same way."""
    (ri, mark_i, rj, mark_j), line = RING, free[3]
    arc = ri * (line - (free[2] + mark_i))
    return _placed(free, _on_i(free, A) + rect(ri - rj, line), line - arc / rj - mark_j, B)


def _rack(free: Free) -> FloatArray:
    """The centre R_j to the left of the pitch line; Q_iD is as long as the arc Q_jD."""
    (own, rj, mark), way = RACK, free[3]
    along = free[2] + own
    centre = _on_i(free, RACK_ORIGIN) + complex(way, rj) * rect(1.0, along)
    # rolling forward turns the pinion clockwise; at way 0 its mark points at the rack
    return _placed(free, centre, along - math.pi / 2 - way / rj - mark, B)


def egg_tangent(alpha: float) -> complex:
    """Derivative of the egg's point [m], by differences."""
    return complex(first_derivative(egg, alpha, 1e-3))


def _cam(free: Free) -> FloatArray:
    """A circle that touches the egg from outside."""
    outward = free[2] + phase(egg_tangent(free[3])) - math.pi / 2
    centre = _on_i(free, A + egg(free[3])) + rect(ROLLER, outward)
    return _placed(free, centre, free[4], B, free[3], outward + math.pi - free[4])


def _flat(free: Free) -> FloatArray:
    """The face along the tangent of the egg, the point of contact anywhere on it."""
    along = free[2] + phase(egg_tangent(free[3]))
    return _placed(free, _on_i(free, A + egg(free[3])) + rect(free[4], along), along - _direction(FACE), B, free[3])


def _point(free: Free) -> FloatArray:
    """The pin of body i anywhere on the egg of body j."""
    return _placed(free, _on_i(free, A), free[4], B + egg(free[3]), free[3])


#: By the keys of `PARTS`, with how many numbers are free.
PLACED: dict[str, tuple[Callable[[Free], FloatArray], int]] = {
    "revolute": (_revolute, 4),
    "translational": (_translational, 4),
    "distance": (_distance, 5),
    "revolute-translational": (_revolute_translational, 5),
    "gears": (_gears, 4),
    "internal-gears": (_ring, 4),
    "rack": (_rack, 4),
    "cam": (_cam, 5),
    "flat": (_flat, 5),
    "point": (_point, 5),
}


#: What differences of eighth order leave, with a safe margin.
_LIMIT = 1e-6
#: A profile without any symmetry [m].
_EGG = harmonic_profile(1.0, (0.1, 0.05), (0.02,))
#: The points as the parts take them; Q of the rack on its pitch line through the first [m].
_A, _B, _Q = ((point.real, point.imag) for point in (A, B, RACK_ORIGIN))


def two_bodies(part: Joint | Contact) -> Mechanism:
    """Two free bodies with one joint or closed contact between them."""
    higher = isinstance(part, CamFollower | CamFlatFollower | PointFollower)
    return Mechanism(
        bodies=(Body("i", 1.0, 1.0, (0.0, 0.0, 0.1)), Body("j", 1.0, 1.0, (1.4, 0.2, -0.2))),
        joints=() if higher else (part,),  # type: ignore[arg-type]
        contacts=(part,) if higher else (),  # type: ignore[arg-type]
    )


PARTS: dict[str, Joint | Contact] = {
    "revolute": Revolute("part", "i", _A, "j", _B),
    "translational": Translational("part", "i", _A, (1.0, 0.4), "j", _B, (1.0, 0.3)),
    "distance": Distance("part", "i", _A, "j", _B, 1.1),
    "revolute-translational": RevoluteTranslational("part", "i", _A, (0.2, 1.0), "j", _B, 0.7),
    "gears": Gears("part", "i", 0.5, 0.3, "j", 0.9, 3.3, _A, _B),
    "internal-gears": InternalGears("part", "i", 1.9, 0.3, "j", 0.6, 0.4, _A, _B),
    "rack": RackAndPinion("part", "i", _A, _Q, 0.2, "j", 0.5, 1.1, _B),
    "cam": CamFollower("part", "i", _EGG, "j", circle(0.25), _A, _B),
    "flat": CamFlatFollower("part", "i", _EGG, "j", _B, (0.3, -1.0), _A),
    "point": PointFollower("part", "i", _A, "j", _EGG, _B),
}


def phi_by_hand(equations: Equations, kind: str) -> float:
    """The largest Phi of a joint in positions that are made by hand; infinite if the same numbers do not move it.

    A seventh position, off by a thousandth in y of body j, must not close it.
    """
    place, free = PLACED[kind]
    positions = [place([1.1 * math.sin(k + 2.3 * n) for n in range(free)]) for k in range(6)]
    largest, opened = (
        max(float(np.abs(equations.at(q + off * np.eye(len(q))[4], 0.0).residual).max()) for q in positions)
        for off in (0.0, 1e-3)
    )
    return largest if opened > 1e-5 else math.inf


def five_steps(kind: str, removed: int, verdict: Verdict) -> Found:
    """The finding of a joint that removes so many degrees of freedom between two bodies."""
    mechanism = two_bodies(PARTS[kind])
    equations, lost = Equations(mechanism, 0.0), 6 - mobility(mechanism).degrees_of_freedom
    # any state will do: the rows need not be closed where they are compared
    numbers = np.arange(len(equations.start))
    state = equations.start + 0.05 * np.sin(1.0 + numbers), np.cos(2.0 * numbers), np.sin(3.0 + numbers)
    deviations = (phi_by_hand(equations, kind), *joint_deviations(equations, *state))
    bad = [name for name, off in zip(("Φ", "Φ_q", "ν", "γ"), deviations, strict=True) if not off <= _LIMIT]
    right = not bad and lost == removed
    wrong = "" if right else f"; off: {', '.join(bad) or 'degrees of freedom'}"
    alphas = ", ".join(name.split(".")[1] for name in equations.coordinates[6:])
    return judged(
        right,
        f"{len(equations.rows)} row{'s' if len(equations.rows) > 1 else ''}"
        f"{f', contact coordinates {alphas}' if alphas else ''}; removes {lost} degree{'s' if lost > 1 else ''} of "
        "freedom; Φ = 0 in 6 positions made by hand from what the slides say; Φ_q, ν, γ = differences of Φ to "
        f"10⁻⁶{wrong}",
        "1 allows, 2 Φ, 3 Φ_q, 4 ν, 5 γ stand in the docstring and on the joint's page",
        "sizes and positions: harness/papers/reproduce/me451/joint_rows.py; two bodies moving at random",
        verdict=verdict,
    )


#: The file of each joint, by the name of its page, in the model and in the engine.
_FILES = {
    **dict.fromkeys(("revolute", "translational", "distance", "revolute_translational"), "pins_and_slides"),
    **dict.fromkeys(("gears", "internal_gears", "rack_and_pinion"), "gears"),
    **dict.fromkeys(("cam_follower", "cam_flat_follower", "point_follower"), "cams"),
    "drivers": "drivers",
}


def _joint(
    key: str, place: str, says: str, printed: str, file: str, removed: int, verdict: Verdict = Verdict.ANSWERED
) -> Row:
    folders = ("mechanism_fmu/model/joints", "mechanism_fmu/engine/constraints/joints")
    code = (*(f"{folder}/{_FILES[file]}.py" for folder in folders), f"docs/joints/{file}.md")
    return Row(f"S-{key}", place, says, printed, code, lambda _bench: five_steps(key, removed, verdict))


_STEPS = "steps 1 to 5 asked, not answered"

ROWS = (
    _joint("revolute", "“Last time”", "Revolute joint.", "named only", "revolute", 2),
    _joint("translational", "“Last time”", "Translational joint.", "named only", "translational", 2),
    _joint("distance", "Composite joints", "Revolute–revolute: a massless rod d_ij.", _STEPS, "distance", 1),
    _joint(
        "revolute-translational",
        "Composite joints",
        "Revolute–translational: P_j at the distance c from an axis.",
        _STEPS,
        "revolute_translational",
        1,
    ),
    _joint("gears", "Gears, eq (2)", "Convex–convex.", "Φ = (r_j^P − r_i^P)ᵀ u⊥ = 0", "gears", 1, Verdict.REPRODUCED),
    _joint(
        "internal-gears",
        "Fig. 3.4.4",
        "Concave–convex: the same approach.",
        "not looked into on the slides",
        "internal_gears",
        1,
    ),
    _joint("rack", "Fig. 3.4.5", "Rack and pinion remove two DOFs.", _STEPS, "rack_and_pinion", 2),
    _joint(
        "cam",
        "Cam–follower pair",
        "Shared contact point and tangent; one α for each body.",
        "x, y, φ, α of both bodies; " + _STEPS,
        "cam_follower",
        1,
    ),
    _joint(
        "flat", "Figs 3.4.10, 3.4.11", "Cam with flat face: a special case.", "not in detail", "cam_flat_follower", 1
    ),
    _joint(
        "point",
        "Fig. 3.4.12",
        "A pin in a slot; the slot's body has α.",
        "x, y, φ; x, y, φ, α; " + _STEPS,
        "point_follower",
        1,
    ),
)
