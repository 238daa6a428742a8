"""Constraint rows against 40-digit arithmetic.

Another file of the same schema may be named by the environment variable JOINT_ORACLE; joints without a test here are
skipped by name.
"""

import json
import math

import numpy as np
import pytest
from textbook import evaluated_rows

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    CamFlatFollower,
    CamFollower,
    Curve,
    Distance,
    DistanceDriver,
    Gears,
    InternalGears,
    Mechanism,
    Piece,
    PointFollower,
    RackAndPinion,
    Revolute,
    RevoluteTranslational,
    Term,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import pack
from tests.exchanged_oracle import is_exchanged, kinds_with_tests, of_kind as skipped_without, oracle_path

OTHER_FILE = "JOINT_ORACLE"


class Numbers:
    """A case's numbers by the oracle's names."""

    def __init__(self, numbers):
        self.numbers = numbers

    def __getattr__(self, name):
        return self.numbers[name]

    def point(self, name):
        return self.numbers[f"{name}_x"], self.numbers[f"{name}_y"]

    def axis(self, name):
        """A direction given by its angle; its length does not matter."""
        return 3.0 * math.cos(self.numbers[name]), 3.0 * math.sin(self.numbers[name])

    def motion(self):
        return curve(Term((self.c0, self.c1, self.c2)))

    def profile_i(self):
        """The constant, a cosine, and a sine of twice the angle."""
        return curve(Term((self.ri0,), self.ri1, 1.0, math.pi / 2), Term((), self.ri2, 2.0))

    def profile_j(self):
        """The constant, a sine, and a cosine of three times the angle."""
        return curve(Term((self.rj0,), self.rj1, 1.0), Term((), self.rj2, 3.0, math.pi / 2))


def curve(*terms):
    return Curve((Piece(0.0, terms),))


#: The oracle's joints as parts; its absolute drivers act on body i, which is body j of a driver here.
JOINTS = {
    "revolute": lambda n: Revolute("part", "i", n.point("siP"), "j", n.point("sjP")),
    "translational": lambda n: Translational(
        "part", "i", n.point("siP"), n.point("vi"), "j", n.point("sjP"), n.point("vj")
    ),
    "distance_rr": lambda n: Distance("part", "i", n.point("siP"), "j", n.point("sjP"), n.C),
    "revolute_translational": lambda n: RevoluteTranslational(
        "part", "i", n.point("siP"), n.axis("vi_angle"), "j", n.point("sjP"), n.C
    ),
    "abs_x_driver": lambda n: XDriver("part", "i", n.point("siP"), n.motion()),
    "abs_y_driver": lambda n: YDriver("part", "i", n.point("siP"), n.motion()),
    "abs_angle_driver": lambda n: AngleDriver("part", "i", n.motion()),
    "abs_distance_driver": lambda n: DistanceDriver("part", "i", n.point("siP"), n.motion(), GROUND, (n.Cx, n.Cy)),
    "rel_x_driver": lambda n: XDriver("part", "j", n.point("sjP"), n.motion(), "i", n.point("siP")),
    "rel_y_driver": lambda n: YDriver("part", "j", n.point("sjP"), n.motion(), "i", n.point("siP")),
    "rel_angle_driver": lambda n: AngleDriver("part", "j", n.motion(), "i"),
    "rel_distance_driver": lambda n: DistanceDriver("part", "j", n.point("sjP"), n.motion(), "i", n.point("siP")),
    "rel_translational_driver": lambda n: TranslationalDriver(
        "part", "j", n.point("sjP"), n.axis("vi_angle"), n.motion(), "i", n.point("siP")
    ),
    "gear_convex_convex": lambda n: Gears(
        "part", "i", n.Ri, n.theta_i, "j", n.Rj, n.theta_j, n.point("siP"), n.point("sjP")
    ),
    "gear_concave_convex": lambda n: InternalGears(
        "part", "i", n.Ri, n.theta_i, "j", n.Rj, n.theta_j, n.point("siP"), n.point("sjP")
    ),
    "rack_and_pinion": lambda n: RackAndPinion(
        "part", "i", n.point("siP"), n.point("siQ"), n.theta_u, "j", n.Rj, n.theta_j, n.point("sjP")
    ),
}
CONTACTS = {
    "cam_follower": lambda n: CamFollower(
        "part", "i", n.profile_i(), "j", n.profile_j(), n.point("siQ"), n.point("sjQ")
    ),
    "cam_flat_follower": lambda n: CamFlatFollower(
        "part", "i", n.profile_i(), "j", n.point("sjP"), n.axis("vj_angle"), n.point("siQ")
    ),
    "point_follower": lambda n: PointFollower("part", "i", n.point("siP"), "j", n.profile_j(), n.point("sjQ")),
}
DATA = json.loads(oracle_path(OTHER_FILE, "joints.json").read_text(encoding="utf-8"))["joints"]
CASES = [
    pytest.param(kind, case, id=f"{kind}-{k}")
    for kind, joint in DATA.items()
    for k, case in enumerate(joint["cases"])
    if kind in JOINTS | CONTACTS
]
#: The oracle's names of coordinates, in the engine's order.
BODIES = {"i": ("xi", "yi", "phii"), "j": ("xj", "yj", "phij")}
ALPHAS = ("alpha_i", "alpha_j")


def rows_of(kind, case):
    """All rows of one case, at the case's rates and at rest."""
    names = DATA[kind]["coords"]
    bodies = [body for body, coordinates in BODIES.items() if coordinates[0] in names]
    assert names == [*(c for body in bodies for c in BODIES[body]), *(name for name in ALPHAS if name in names)]
    part = (JOINTS | CONTACTS)[kind](Numbers(case["attrs"]))
    place = {"joints": (part,)} if kind in JOINTS else {"contacts": (part,)}
    block = pack(compile_mechanism(Mechanism(bodies=tuple(Body(body, 1.0, 1.0) for body in bodies), **place)))
    q, qd = np.array(case["q"]), np.array(case["qd"])
    return evaluated_rows(block, q, qd, case["t"]), evaluated_rows(block, q, 0 * qd, case["t"])


@pytest.mark.parametrize(("kind", "case"), skipped_without(OTHER_FILE, "any joint known here", CASES, arguments=2))
def test_rows_agree_with_the_oracle(kind, case):
    moving, resting = rows_of(kind, case)
    for name, oracle_name in (("phi", "Phi"), ("gamma", "gamma"), ("jacobian", "Phi_q"), ("nu", "nu")):
        agree(getattr(moving, name), case[oracle_name], name)
    agree(-resting.rate, case["nu"], "nu")  # at rest Phi' = -nu
    agree(moving.rate, np.dot(case["Phi_q"], case["qd"]) - case["nu"], "rate")


def agree(found, expected, name):
    """To 1e-11 of each number, and to rounding of the largest where numbers cancel."""
    largest = max(1.0, np.abs(expected).max())
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-14 * largest, err_msg=name)


def test_the_oracle_knows_every_joint():
    assert is_exchanged(OTHER_FILE) or set(DATA) == set(JOINTS | CONTACTS)


@pytest.mark.parametrize("kind", kinds_with_tests(OTHER_FILE, DATA, JOINTS | CONTACTS))
def test_kind_is_known(kind):
    assert kind in JOINTS | CONTACTS
