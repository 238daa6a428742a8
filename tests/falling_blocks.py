"""Blocks that fall from different heights and stay where they land, each on two points: 60 contacts.

Block k lands at LANDS * (k + 1), flat and without bounce: then its two contacts strike at once, and 2 k are closed.
"""

from types import SimpleNamespace

from mechanism_fmu.model import GROUND, Mechanism, Model, Output, PointLineContact, rigid_body

#: Acceleration of gravity [m/s2], the time between two landings [s], and mass of a block [kg].
GRAVITY, LANDS, MASS = 10.0, 0.01, 2.0
#: Half the width of a block, half its height, and from one to the next [m].
HALF, LOW, APART = 0.1, 0.05, 0.3


def blocks(count: int) -> Mechanism:
    """So many blocks, and twice as many contacts."""
    bodies, contacts = [], []
    for k in range(count):
        height = 0.5 * GRAVITY * (LANDS * (k + 1)) ** 2
        block = rigid_body(f"block{k}", (APART * k, LOW + height), mass=MASS, inertia=0.01)
        bodies.append(block)
        for side, x in (("left", -HALF), ("right", HALF)):
            contacts.append(PointLineContact(f"{side}{k}", block.at(x, -LOW), GROUND.line((0.0, 0.0), (1.0, 0.0))))
    outputs = (
        Output("impacts", "impact.count", "Impacts so far", type="Integer"),
        Output("force", "right0.force", "Force on the first block, at its right", "N"),
        Output("last_force", f"right{count - 1}.force", "Force on the last block, at its right", "N"),
    )
    return Mechanism(tuple(bodies), contacts=tuple(contacts), gravity=(0.0, -GRAVITY), outputs=outputs)


def mechanism(values: SimpleNamespace) -> Mechanism:
    return blocks(30)


MODEL = Model("FallingBlocks", "Blocks that fall one after the other", (), mechanism)
