"""The joints of the ME451 slides: each one's five steps, by hand and against differences of its own Phi."""

from __future__ import annotations

import math
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

from ....run.checks import Verdict
from ..bench import Bench, FloatArray, joint_deviations
from ..row import Found, Row, judged

# Two bodies placed by hand as each joint of the ME451 slides says, so that its Phi must vanish there.
#
# Each function takes numbers at will, as many as degrees of freedom remain, and returns the coordinates of both bodies
# (and contact angles), from geometry alone: distances, arcs and tangents by differences, without any constraint row.

A, B = np.array([0.3, -0.2]), np.array([-0.25, 0.4])
#: Distances, radii, marks and directions of the parts, as in `PARTS`.
ROD, OFFSET, ROLLER = 1.1, 0.7, 0.25
GEARS, RING, RACK = (0.5, 0.3, 0.9, 3.3), (1.9, 0.3, 0.6, 0.4), (0.2, 0.5, 1.1)
RACK_ORIGIN = A + 0.6 * np.array([math.cos(0.2), math.sin(0.2)])
AXIS_I, AXIS_J, GUIDE, FACE = (1.0, 0.4), (1.0, 0.3), (0.2, 1.0), (0.3, -1.0)

Free = Sequence[float]


def egg(alpha: float) -> float:
    """Radius of the profile without any symmetry [m]."""
    return 1.0 + 0.1 * math.cos(alpha) + 0.05 * math.cos(2 * alpha) + 0.02 * math.sin(alpha)


def turned(vector: Sequence[float] | FloatArray, angle: float) -> FloatArray:
    """A vector turned by an angle."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def _direction(vector: Sequence[float] | FloatArray) -> float:
    return math.atan2(float(vector[1]), float(vector[0]))


def _unit(angle: float) -> FloatArray:
    return np.array([math.cos(angle), math.sin(angle)])


def _placed(free: Free, point: FloatArray, phi_j: float, on_j: FloatArray, *alphas: float) -> FloatArray:
    """Body i at free[:3], body j turned by phi_j with its point `on_j` at `point`."""
    return np.array([*free[:3], *(point - turned(on_j, phi_j)), phi_j, *alphas])


def _on_i(free: Free, point: Sequence[float] | FloatArray) -> FloatArray:
    return np.array(free[:2]) + turned(point, free[2])


def _revolute(free: Free) -> FloatArray:
    return _placed(free, _on_i(free, A), free[3], B)


def _translational(free: Free) -> FloatArray:
    """Both axes on one line, at any distance along it."""
    axis = free[2] + _direction(AXIS_I)
    return _placed(free, _on_i(free, A) + free[3] * _unit(axis), axis - _direction(AXIS_J), B)


def _distance(free: Free) -> FloatArray:
    return _placed(free, _on_i(free, A) + ROD * _unit(free[3]), free[4], B)


def _revolute_translational(free: Free) -> FloatArray:
    """P_j at c from the axis, any way along it."""
    axis = free[2] + _direction(GUIDE)
    return _placed(free, _on_i(free, A) + free[3] * _unit(axis) + OFFSET * _unit(axis + math.pi / 2), free[4], B)


def _gears(free: Free) -> FloatArray:
    """Centres R_i + R_j apart; the arcs from the marks to the point of contact are equal."""
    ri, mark_i, rj, mark_j = GEARS
    line = free[3]
    arc = ri * (line - (free[2] + mark_i))
    # the contact is on the other side of gear j, and it turns the other way
    phi_j = line + math.pi + arc / rj - mark_j
    return _placed(free, _on_i(free, A) + (ri + rj) * _unit(line), phi_j, B)


def _ring(free: Free) -> FloatArray:
    """Centres R_i - R_j apart; both marks are on the same side, and both arcs run the same way."""
    ri, mark_i, rj, mark_j = RING
    line = free[3]
    phi_j = line - ri * (line - (free[2] + mark_i)) / rj - mark_j
    return _placed(free, _on_i(free, A) + (ri - rj) * _unit(line), phi_j, B)


def _rack(free: Free) -> FloatArray:
    """The centre R_j to the left of the pitch line; Q_iD is as long as the arc Q_jD."""
    own, rj, mark = RACK
    along, way = free[2] + own, free[3]
    centre = _on_i(free, RACK_ORIGIN) + way * _unit(along) + rj * _unit(along + math.pi / 2)
    # rolling forward turns the pinion clockwise; at way 0 its mark points at the rack
    return _placed(free, centre, along - math.pi / 2 - way / rj - mark, B)


def _boundary(alpha: float) -> tuple[FloatArray, float]:
    """Place and direction of the egg's tangent [rad], the latter by differences."""
    h = 1e-3
    place = [egg(alpha + k * h) * _unit(alpha + k * h) for k in (-2, -1, 0, 1, 2)]
    return place[2], _direction(place[0] - 8 * place[1] + 8 * place[3] - place[4])


def _cam(free: Free) -> FloatArray:
    """A circle that touches the egg from outside."""
    place, tangent = _boundary(free[3])
    contact, outward = _on_i(free, A + place), free[2] + tangent - math.pi / 2
    centre = contact + ROLLER * _unit(outward)
    return _placed(free, centre, free[4], B, free[3], outward + math.pi - free[4])


def _flat(free: Free) -> FloatArray:
    """The face along the tangent of the egg, the point of contact anywhere on it."""
    place, tangent = _boundary(free[3])
    along = free[2] + tangent
    return _placed(free, _on_i(free, A + place) + free[4] * _unit(along), along - _direction(FACE), B, free[3])


def _point(free: Free) -> FloatArray:
    """The pin of body i anywhere on the egg of body j."""
    alpha, phi_j = free[3], free[4]
    return _placed(free, _on_i(free, A), phi_j, B + egg(alpha) * _unit(alpha), alpha)


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


JOINTS = "mechanism_fmu/model/joints"
ROWS_OF_JOINTS = "mechanism_fmu/engine/constraints/joints"
#: What differences of eighth order leave, with a safe margin.
_LIMIT = 1e-6
#: A profile without any symmetry [m].
_EGG = harmonic_profile(1.0, (0.1, 0.05), (0.02,))

_A, _B = (0.3, -0.2), (-0.25, 0.4)
#: Q of the rack, on its pitch line through _A [m].
_Q = (0.3 + 0.6 * math.cos(0.2), -0.2 + 0.6 * math.sin(0.2))


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
    largest = max(float(np.abs(equations.at(q, 0.0).residual).max()) for q in positions)
    beside = [q + 1e-3 * np.eye(len(q))[4] for q in positions]
    opened = max(float(np.abs(equations.at(q, 0.0).residual).max()) for q in beside)
    return largest if opened > 1e-5 else math.inf


def five_steps(kind: str, removed: int, verdict: Verdict = Verdict.ANSWERED) -> Callable[[Bench], Found]:
    """The finding of a joint that removes so many degrees of freedom between two bodies."""

    def find(_bench: Bench) -> Found:
        mechanism = two_bodies(PARTS[kind])
        equations = Equations(mechanism, 0.0)
        count = len(equations.start)
        # any state will do: the rows need not be closed where they are compared
        q = equations.start + 0.05 * np.sin(1.0 + np.arange(count))
        rate, acceleration = np.cos(2.0 * np.arange(count)), np.sin(3.0 + np.arange(count))
        deviations = (phi_by_hand(equations, kind), *joint_deviations(equations, q, rate, acceleration))
        contact = count - 6
        freedom = mobility(mechanism).degrees_of_freedom
        names = ("Φ", "Φ_q", "ν", "γ")
        bad = [name for name, off in zip(names, deviations, strict=True) if not off <= _LIMIT]
        rows = f"{len(equations.rows)} row{'s' if len(equations.rows) > 1 else ''}"
        alphas = f", contact coordinates {', '.join(c.split('.')[1] for c in equations.coordinates[6:])}"
        right = not bad and 6 - freedom == removed
        wrong = "" if right else f"; off: {', '.join(bad) or 'degrees of freedom'}"
        return judged(
            right,
            f"{rows}{alphas if contact else ''}; removes {6 - freedom} degree{'s' if freedom != 5 else ''} of "
            "freedom; Φ = 0 in 6 positions made by hand from what the slides say; Φ_q, ν, γ = differences of Φ to "
            f"10⁻⁶{wrong}",
            "1 allows, 2 Φ, 3 Φ_q, 4 ν, 5 γ stand in the docstring and on the joint's page",
            "sizes and positions: harness/papers/reproduce/me451/joint_rows.py; two bodies moving at random",
            verdict=verdict,
        )

    return find


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
    code = (f"{JOINTS}/{_FILES[file]}.py", f"{ROWS_OF_JOINTS}/{_FILES[file]}.py", f"docs/joints/{file}.md")
    return Row(f"S-{key}", place, says, printed, code, five_steps(key, removed, verdict))


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
