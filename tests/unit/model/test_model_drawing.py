import math
from types import SimpleNamespace

import pytest

from mechanism_fmu.model import Bar, Disc, Hinge, MechanismError, Polyline, Striker, Wheel
from mechanism_fmu.model.drawing import check_drawing, quantities
from mechanism_fmu.model.sawtooth import wheel_outline
from models.ratchet.model import MODEL
from models.ratchet.ports import calculated
from models.ratchet.start import tooth

VARIABLES = {"phi", "length", "teeth", "radius"}
CRANK = Bar("crank", (0.0, 0.0), "phi", "length")


def test_a_drawing_that_stands_on_its_own_is_accepted() -> None:
    pawl = Bar("pawl", "crank", "-phi", 0.1)
    wheel = Wheel("wheel", ("-length", 0), "phi", "teeth", (("radius", 0.0), (0.2, "-phi")))
    check_drawing([CRANK, pawl, wheel, Disc("pin", "pawl", "radius"), Hinge("crank"), Striker("pawl")], VARIABLES)
    check_drawing([], [])


@pytest.mark.parametrize(
    ("shapes", "message"),
    [
        ([Bar("crank", (0.0, 0.0), "psi", 1.0)], r"Bar 'crank': the model has no variable 'psi'; name one of its"),
        ([Bar("crank", ("-d", 0.0), 0.0, 1.0)], "no variable 'd'"),
        ([Wheel("wheel", (0.0, 0.0), 0.0, 3, ((1.0, "apex"),))], "Wheel 'wheel': the model has no variable 'apex'"),
        ([Hinge((0.0, "y"))], r"Hinge \(shape 1\): the model has no variable 'y'"),
        ([Polyline("teeth", (0.0, 0.0), 0.0, ((1.0, 0.0),), (("step", 0.0, 0.0),))], "no variable 'step'"),
        ([Disc("disc", (0.0, 0.0), math.nan)], "Disc 'disc': nan is not a finite number"),
        (
            [CRANK, Bar("pawl", "crnk", 0.0, 1.0)],
            "Bar 'pawl': there is no bar 'crnk' before it .* bars before it: crank",
        ),
        ([Striker("crank"), CRANK], r"Striker \(shape 1\): there is no bar 'crank' before it .*: none"),
        ([CRANK, CRANK], "two shapes are named 'crank'"),
        ([Disc("disc", (0.0, 0.0), 1.0), Hinge("disc")], "no bar 'disc'"),
    ],
)
def test_what_does_not_exist_is_named(shapes: list[Bar], message: str) -> None:
    with pytest.raises(MechanismError, match=message):
        check_drawing(shapes, VARIABLES)


def test_quantities_are_all_numbers_of_a_shape_and_no_names() -> None:
    wheel = Wheel("wheel", (1.0, 2.0), "phi", "teeth", ((3.0, 4.0), (5.0, 6.0)), clockwise=True)
    assert list(quantities(wheel)) == [1.0, 2.0, "phi", "teeth", 3.0, 4.0, 5.0, 6.0]
    teeth = Polyline("teeth", (1.0, 2.0), "phi", ((3.0, 4.0),), ((5.0, "step", 6.0),))
    assert list(quantities(teeth)) == [1.0, 2.0, "phi", 3.0, 4.0, 5.0, "step", 6.0]
    assert list(quantities(CRANK)) == [0.0, 0.0, "phi", "length"]
    assert list(quantities(Hinge("crank"))) == []


@pytest.mark.parametrize(("teeth", "angle"), [(10, 90), (25, 85), (3, 100), (15, 105)])
def test_the_ratchet_s_wheel_is_its_polygon(teeth: int, angle: int) -> None:
    values = MODEL.values(tooth_count=teeth, tooth_slope_angle=math.radians(angle))
    known = vars(values) | {port.name: port.value for port in calculated(values)}
    number = SimpleNamespace(of=lambda quantity: known[quantity] if isinstance(quantity, str) else quantity)
    wheel = next(shape for shape in MODEL.drawing if isinstance(shape, Wheel))
    pitch = (-1 if wheel.clockwise else 1) * 2 * math.pi / number.of(wheel.count)
    rim = [
        (
            number.of(radius) * math.cos(number.of(at) + k * pitch),
            number.of(radius) * math.sin(number.of(at) + k * pitch),
        )
        for k in range(teeth)
        for radius, at in wheel.outline
    ]
    polygon = wheel_outline(tooth(values), teeth, values.wheel_inner_radius)
    assert [x for point in rim for x in point] == pytest.approx([x for point in polygon for x in point], abs=1e-15)
    assert known["tooth_apex_offset"] < 0 < known["tooth_apex_radius"]
