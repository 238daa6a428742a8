"""Rocking block: let go tilted by half its critical angle, it rocks from corner to corner, and each impact takes speed.

The corner that it stands on does not slide: a row holds it in place as long as the block leans over it. Source:
Housner, The behavior of inverted pendulum structures during earthquakes, Bulletin of the Seismological Society of
America 53 (1963): the speed after an impact is 1 - 3/2 sin(alpha)^2 of that before, alpha being the critical angle.
"""

from mechanism_fmu.model import (
    GROUND,
    LogicalFunction,
    Mechanism,
    Model,
    Output,
    PointLineContact,
    angle_output,
    impact_outputs,
    length_parameter,
    plate,
    speed_output,
)
from mechanism_fmu.model.functions import atan2


def mechanism(values):
    """A block that leans over its right lower corner, which is the origin of its frame."""
    b, h = values.width, values.height
    block = plate("block", ((-b, 0), (0, 0), (0, h), (-b, h)), mass="1 kg", angle=-0.5 * atan2(b, h))
    left, right, *_ = block.corners
    floor, up = GROUND.line((0, 0), (1, 0)), (0, 1)
    lands = (PointLineContact("left", left, floor), PointLineContact("right", right, floor, closed=True))
    holds = PointLineContact("left_hold", left, GROUND.line((-b, 0), up), closed_while="not leans_right")
    holds = (holds, PointLineContact("right_hold", right, GROUND.line((0, 0), up), closed_while="leans_right"))
    leans = LogicalFunction("leans_right", of=block.angle, below=0.0)
    impacts = impact_outputs("Impacts on the floor", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    outputs = (angle_output("angle", block.angle, "Tilt"), speed_output("speed", block.speed, "Rate"), *impacts)
    parts = {"contacts": (*lands, *holds), "functions": (leans,), "held": (block.angle,)}
    return Mechanism((block,), gravity=(0.0, -9.81), outputs=outputs, **parts)


SIZES = (length_parameter("width", "200 mm", "Width"), length_parameter("height", "800 mm", "Height"))
MODEL = Model("RockingBlock", "Block that rocks on a floor", SIZES, mechanism, stop_time=3.0)
