"""What outputs read: the factors of forces in joints, of motors, of members, by hand; 0 where there is none."""

from types import SimpleNamespace

import pytest

from mechanism_fmu.model import ClearanceJoint, DCMotor, Distance, Revolute
from mechanism_fmu.model.sources import output_factor

PLAY = ClearanceJoint(
    "play",
    "arm",
    "ground",
    point_i=(0.0, 0.0),
    point_j=(0.0, 0.0),
    pin_radius=0.1,
    clearance=0.5,
    wear_coefficient=3.0,
)
MECHANISM = SimpleNamespace(
    members=(SimpleNamespace(name="bar"),),
    contacts=(PLAY,),
    forces=(DCMotor("motor", "arm", constant=0.05),),
    joints=(
        Revolute("pin", "ground", "arm", (0.0, 0.0), (0.0, 0.0)),
        Distance("rod", "ground", "arm", (0.0, 0.0), (0.0, 0.0), 0.3),
    ),
)


@pytest.mark.parametrize(
    ("source", "factor"),
    [
        ("pin.force_x", 1.0),
        ("rod.force", -0.6),
        ("bar.start_moment", -1.0),
        ("bar.end_moment", 1.0),
        ("pin.nothing", 0.0),
        ("arm.angle", 0.0),
        ("nobody.force", 0.0),
        ("play.eccentricity", 2.0),
        ("play.sliding_work", 1.0),
        ("play.wear_volume", 3.0),
        ("play.force", 0.0),
    ],
)
def test_factors_of_outputs(source: str, factor: float) -> None:
    assert output_factor(source, MECHANISM) == factor  # type: ignore[arg-type]
