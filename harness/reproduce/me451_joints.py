"""The joints of the ME451 slides: each one's five steps, against differences of its own Phi along a motion."""

from __future__ import annotations

from collections.abc import Callable

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

from .bench import Bench
from .differences import joint_deviations
from .row import Found, Row, Verdict

JOINTS = "mechanism_fmu/model/joints"
ROWS_OF_JOINTS = "mechanism_fmu/engine/constraints/joints"
#: What differences of eighth order leave, with a safe margin.
_LIMIT = 1e-6
#: A profile without any symmetry [m].
_EGG = harmonic_profile(1.0, (0.1, 0.05), (0.02,))

_A, _B = (0.3, -0.2), (-0.25, 0.4)


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
    "rack": RackAndPinion("part", "i", _A, (0.9, 0.1), 0.2, "j", 0.5, 1.1, _B),
    "cam": CamFollower("part", "i", _EGG, "j", circle(0.25), _A, _B),
    "flat": CamFlatFollower("part", "i", _EGG, "j", _B, (0.3, -1.0), _A),
    "point": PointFollower("part", "i", _A, "j", _EGG, _B),
}


def five_steps(kind: str, removed: int) -> Callable[[Bench], Found]:
    """The finding of a joint that removes so many degrees of freedom between two bodies."""

    def find(_bench: Bench) -> Found:
        mechanism = two_bodies(PARTS[kind])
        equations = Equations(mechanism, 0.0)
        count = len(equations.start)
        # any state will do: the rows need not be closed where they are compared
        q = equations.start + 0.05 * np.sin(1.0 + np.arange(count))
        rate, acceleration = np.cos(2.0 * np.arange(count)), np.sin(3.0 + np.arange(count))
        deviations = joint_deviations(equations, q, rate, acceleration)
        contact = count - 6
        freedom = mobility(mechanism).degrees_of_freedom
        names = ("Φ_q", "ν", "γ")
        bad = [name for name, off in zip(names, deviations, strict=True) if not off <= _LIMIT]
        rows = f"{len(equations.rows)} row{'s' if len(equations.rows) > 1 else ''}"
        alphas = f", contact coordinates {', '.join(c.split('.')[1] for c in equations.coordinates[6:])}"
        right = not bad and 6 - freedom == removed
        wrong = "" if right else f"; off: {', '.join(bad) or 'degrees of freedom'}"
        return Found(
            f"{rows}{alphas if contact else ''}; removes {6 - freedom} degree{'s' if freedom != 5 else ''} of "
            f"freedom; Φ_q, ν, γ = differences of Φ to 10⁻⁶{wrong}",
            Verdict.REPRODUCED if right else Verdict.FAILED,
            (
                "1 allows, 2 Φ, 3 Φ_q, 4 ν, 5 γ stand in the docstring and on the joint's page",
                "sizes of the parts: harness/reproduce/me451_joints.py; two bodies in general position, moving at "
                "random",
            ),
        )

    return find


def _joint(key: str, place: str, says: str, printed: str, file: str, removed: int) -> Row:
    code = (f"{JOINTS}/{file}.py", f"{ROWS_OF_JOINTS}/{file.removeprefix('internal_')}.py", f"docs/joints/{file}.md")
    return Row(f"S-{key}", place, says, printed, code, five_steps(key, removed))


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
    _joint("gears", "Gears, eq (2)", "Convex–convex.", "Φ = (r_j^P − r_i^P)ᵀ u⊥ = 0", "gears", 1),
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
