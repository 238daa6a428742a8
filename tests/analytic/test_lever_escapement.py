"""A lever escapement with two pallets: rounded teeth that come off a pallet's corner meet the face beside it."""

import math

import numpy as np

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    CircularCopies,
    Damper,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
    Revolute,
    Torque,
    TorsionSpring,
    deadbeat_pallet,
    deg,
    mm,
    pin_tooth,
    rigid_body,
)
from mechanism_fmu.model.functions import cos
from mechanism_fmu.simulation import simulate

#: Of the balance [kg m2].
INERTIA = 5e-5


def lever_escapement() -> Mechanism:
    """Wheel, lever and balance have their axes above each other; the wheel turns about the origin, clockwise."""
    radius, count = mm(30), 30
    arbor, fork, arm = radius / cos(deg(45)), mm(60), mm(8)
    wheel = rigid_body("wheel", mass="10 g", inertia=1e-6, angle=deg(135) + 1.7e-3 / radius)
    lever = rigid_body("lever", (0, arbor), mass="10 g", inertia=2e-6, angle=deg(2.5))
    balance = rigid_body("balance", (0, arbor + fork + arm), mass="50 g", inertia=INERTIA, angle=deg(-90))
    inner, outer = radius - mm(1.3), radius + mm(1.3)
    pallets = {  # corners of the impulse face on the inner and the outer arc, and the far end
        "entry": deadbeat_pallet(inner, outer, deg(226.5), deg(224.5), deg(216.5)),
        "exit": deadbeat_pallet(inner, outer, deg(315.5), deg(313.5), deg(323.5)),
    }
    tooth, copies = pin_tooth(count, radius, mm(0.2)), CircularCopies(count)
    contacts = [
        OutlineContact(name, lever, wheel, outline_i=pallet, outline_j=tooth, copies=copies)
        for name, pallet in pallets.items()
    ]
    sides = (-3, -4), (3, -4), (3, -0.3), (1.05, -0.3), (1.05, -3), (-1.05, -3), (-1.05, -0.3), (-3, -0.3)
    notch = Outline.polygon([(mm(x), fork + mm(y)) for x, y in sides])
    pin = Outline.circle(mm(1), (0.0, -arm))
    contacts.append(OutlineContact("pin", balance, lever, outline_i=pin, outline_j=notch))
    contacts += [AngleStop("left", GROUND, lever, angle=deg(-2.5)), AngleStop("right", lever, GROUND, angle=deg(-2.5))]
    joints = (
        Revolute("pivot", wheel.at(0, 0), GROUND),
        Revolute("lever_pivot", lever.at(0, 0), GROUND.at(0, arbor)),
        Revolute("staff", balance.at(0, 0), GROUND.at(0, arbor + fork + arm)),
    )
    swing = 2.5 * 2.0 * deg(180)
    forces = (
        Torque("mainspring", wheel, torque=-1.0 * 2e-3),
        TorsionSpring("hairspring", balance, stiffness=INERTIA * swing * swing),
        Damper("air", balance, damping=INERTIA * swing / 50.0),
    )
    outputs = (Output("wheel", "wheel.angle", "", "rad"), Output("balance", "balance.angle", "", "rad"))
    return Mechanism((wheel, lever, balance), joints, forces, tuple(contacts), outputs=outputs)


def test_it_ticks() -> None:
    """Half a tooth at each half swing of the balance, which swings beyond the lever."""
    result = simulate(lever_escapement(), 8.0, step=0.01)
    crossings = np.count_nonzero(np.diff(np.sign(result["balance"])))
    turned = (result["wheel"][0] - result["wheel"][-1]) / (math.tau / 60)
    assert 39 <= crossings <= 41
    assert abs(turned - crossings) < 1.5
    assert max(abs(result["balance"][-50:])) > 0.5
