"""Friction on normal forces that rows share at will: the event says so wherever accelerations depend on the shares.

Against linear programmes: the least and the largest acceleration over all shares that agree with all laws.
"""

from itertools import combinations

import numpy as np
import pytest
from scipy.linalg import null_space
from scipy.optimize import linprog

from mechanism_fmu.model import (
    GROUND,
    Input,
    Mechanism,
    Output,
    PointForce,
    PointLineContact,
    RackAndPinion,
    Revolute,
    Translational,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation, simulate

GRAVITY = 9.81
FLOOR = GROUND.line((0, 0), (1, 0))
#: Of the accelerations in the sum whose extremes are sought: where any of them varies, the sum does.
WEIGHTS = np.array([1.0, 0.7, 0.31])


class Plank:
    """A body on feet at x [m] from its centre of mass and on the floor, which slides with v [m/s] and is pushed."""

    def __init__(self, x, friction, v=1.0, height=0.1, push=(0.0, 0.0, 0.0), mass=2.0, inertia=0.3, guided=False):
        self.x, self.friction, self.sense = np.array(x, float), np.array(friction, float), np.sign(v)
        self.height, self.guided = height, guided
        self.push = np.array(push, float) - np.array([0.0, mass * GRAVITY, 0.0])
        self.inverse_mass = np.diag([1 / mass, 1 / mass, 1 / inertia])
        body = rigid_body("plank", (0.0, height), mass=mass, inertia=inertia, velocity=(v, 0.0))
        feet = tuple(
            PointLineContact(f"foot{k}", body.at(a, -height), FLOOR, closed=True, friction=mu, guided=guided)
            for k, (a, mu) in enumerate(zip(x, friction, strict=True))
        )
        # a torque is a force with a lever: three of them make any push
        forces = (PointForce("push", body.at(0, 0)), PointForce("above", body.at(0, 1)), PointForce("back", body))
        inputs = tuple(
            Input(name, f"{name}.x", value, "", "N")
            for name, value in (("push", push[0]), ("above", -push[2]), ("back", push[2]))
        )
        lift = (Input("lift", "push.y", push[1], "", "N"),)
        outputs = tuple(Output(f"force{k}", f"foot{k}.force", "", "N") for k in range(len(x)))
        self.mechanism = Mechanism(
            (body,), contacts=feet, forces=forces, inputs=inputs + lift, outputs=outputs, gravity=(0.0, -GRAVITY)
        )

    def rows(self, sign=1.0):
        """Rows of the feet, and their forces with friction on the body by a unit of each multiplier."""
        normal = np.array([[0.0, 1.0, a] for a in self.x])
        along = np.array([[1.0, 0.0, self.height]] * len(self.x))
        return normal, normal - (self.sense * self.friction * sign)[:, None] * along

    def spread(self):
        """The difference that shares make to a sum of accelerations with any weights, as a share of gravity."""
        normal, force = self.rows()
        values = []
        count = len(self.x)
        matrix = normal @ self.inverse_mass
        for size in range(1, count + 1):
            for closed in map(list, combinations(range(count), size)):
                opened = [k for k in range(count) if k not in closed]
                equal = (matrix[closed] @ force[closed].T, -matrix[closed] @ self.push)
                above = (-matrix[opened] @ force[closed].T, matrix[opened] @ self.push) if opened else (None, None)
                for side in (1.0, -1.0):
                    cost = side * WEIGHTS @ self.inverse_mass @ force[closed].T
                    found = linprog(cost, above[0], above[1], *equal, method="highs")
                    if found.status == 0:
                        values.append(side * found.fun)
        return (max(values) - min(values)) / GRAVITY if values else 0.0

    def spread_of_guides(self, forces):
        """As `spread`, where feet hold from both sides: by all shares near those of these forces."""
        normal, force = self.rows(np.where(np.array(forces) < 0.0, -1.0, 1.0))
        shares = null_space(normal @ self.inverse_mass @ force.T, rcond=1e-11)
        return float(np.abs(self.inverse_mass @ force.T @ shares).max(initial=0.0))

    def named(self):
        """Names of undetermined friction at the start."""
        return [event.guard for event in Simulation(self.mechanism).events_in_step()]


def draw(rng):
    """A plank: places random, equal, aligned with the centre of mass; coefficients random, equal, linear or zero."""
    count = int(rng.integers(1, 6))
    x = rng.uniform(-1.0, 1.0, count)
    if rng.random() < 0.4:
        x = rng.choice([-0.5, -0.25, 0.0, 0.25, 0.5], count)  # some at the same place, or below the centre of mass
    friction = rng.uniform(0.0, 0.6, count)
    kind = rng.integers(5)
    if kind == 0:
        friction[:] = friction[0]
    elif kind == 1:
        friction = 0.3 + 0.2 * x
    elif kind == 2:
        friction = rng.choice([0.0, 0.2, 0.4], count)
    elif kind == 3:
        friction[x == x[0]] = friction[0]
    push = np.zeros(3) if rng.random() < 0.5 else rng.uniform(-5.0, 5.0, 3)
    v, height = float(rng.choice([-1.0, 1.0])), float(rng.choice([0.0, 0.1]))
    return {"x": x, "friction": friction, "v": v, "height": height, "push": push}


def judge(plank, spread):
    """Compare; between what rounding makes and what can be seen nothing is said."""
    named = plank.named()
    if spread > 1e-6:
        assert len(named) == 1
        assert named[0].endswith(".undetermined")
    elif spread < 1e-9:
        assert named == []


@pytest.mark.parametrize("seed", range(60))
def test_a_plank_on_feet_is_undetermined_where_its_acceleration_depends_on_shares(seed):
    plank = Plank(**draw(np.random.default_rng(seed)))
    judge(plank, plank.spread())


@pytest.mark.parametrize("seed", range(80))
def test_a_plank_in_guides_is_undetermined_where_its_acceleration_depends_on_shares(seed):
    plank = Plank(**draw(np.random.default_rng(seed)), guided=True)
    forces = Simulation(plank.mechanism).read()
    judge(plank, plank.spread_of_guides([forces[f"force{k}"] for k in range(len(plank.x))]))


@pytest.mark.parametrize(
    ("x", "named"),
    [((-0.5, 0.0, 0.5), ["foot0.undetermined"]), ((0.0, 0.25, 0.5), []), ((0.1, -0.4, -0.45), ["foot0.undetermined"])],
    ids=["between", "above an outer foot", "near an outer foot"],
)
def test_feet_without_force_share_only_what_presses_them(x, named):
    """Above an outer foot all others are without force; near one, that of least norm is, though others may press it."""
    plank = Plank(x, (0.1, 0.5, 0.2), height=0.0)
    assert bool(named) == (plank.spread() > 1e-6)
    assert plank.named() == named


def test_the_start_is_told_to_whoever_looks_and_once():
    """Right behind the start, behind the first step but no later one, and in the events of a run."""
    plank = Plank((-0.5, 0.0, 0.5), (0.1, 0.6, 0.2)).mechanism
    simulation = Simulation(plank)
    for named in (["foot0.undetermined"], ["foot0.undetermined"], []):
        assert [event.guard for event in simulation.events_in_step()] == named
        simulation.advance(simulation.time + 0.05)
    run = simulate(plank, until=0.2, step=0.01, inputs={"push": lambda t: t})
    assert [(event.guard, event.time) for event in run.events] == [("foot0.undetermined", 0.0)]
    assert run.statistics.events == 1


def test_a_plank_that_begins_to_slide_does_so_once():
    """Foot after foot comes to its bound, of the shares of least norm, while the others hold: that moves nothing."""
    plank = Plank((-0.5, 0.0, 0.5), (0.1, 0.6, 0.2), v=0.0, height=0.0).mechanism
    run = simulate(plank, until=1.0, step=0.01, inputs={"push": lambda t: 20.0 * t})
    assert [event.guard for event in run.events] == ["foot0.undetermined", "foot1.slips"]


@pytest.mark.parametrize("friction", [(0.3, 0.3), (0.3, 0.1)], ids=["equal", "unequal"])
def test_two_guides_of_a_slider_have_a_sum(friction):
    """With one coefficient the sum of their forces is all that counts."""
    slider = rigid_body("slider", (0, 0), mass=2.0, inertia=0.1, velocity=(1.0, 0.0))
    guides = tuple(
        Translational(f"guide{k}", GROUND.line((0, y), (1, 0)), slider.line((0, y), (1, 0)), friction=mu)
        for k, (y, mu) in enumerate(zip((0.1, -0.1), friction, strict=True))
    )
    outputs = (Output("v", "slider.x_rate", "", "m/s"),)
    simulation = Simulation(Mechanism((slider,), guides, gravity=(0.0, -GRAVITY), outputs=outputs))
    named = [event.guard for event in simulation.events_in_step()]
    assert named == ([] if friction[0] == friction[1] else ["guide0.undetermined"])
    simulation.advance(0.1)
    assert simulation.read()["v"] == pytest.approx(1.0 - sum(friction) / 2 * GRAVITY * 0.1, abs=1e-12)


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_rack_that_presses_a_block_on_its_table_shares_its_weight(friction):
    """The pinion on a fixed hinge holds the rack from above as the table does from below."""
    block = rigid_body("block", (0, 0), mass=1.0, inertia=0.01, velocity=(1.0, 0.0))
    pinion = rigid_body("pinion", (0, 0.05), mass=1e-3, inertia=1e-6, speed=20.0)
    joints = (
        Translational("table", GROUND.line((0, 0), (1, 0)), block.line((0, 0), (1, 0)), friction=friction),
        Revolute("axle", pinion.at(0, 0), GROUND.at(0, 0.05)),
        RackAndPinion(
            "rack", block.line((0, 0), (1, 0)), pinion.at(0, 0), block.at(0, 0), radius_j=0.05, angle_j=-np.pi / 2
        ),
    )
    simulation = Simulation(Mechanism((block, pinion), joints, gravity=(0.0, -GRAVITY)))
    assert [event.guard for event in simulation.events_in_step()] == (["table.undetermined"] if friction else [])
