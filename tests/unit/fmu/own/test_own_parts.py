"""A user's mechanism whose parts cannot be right: what is said, and of which line."""

from pathlib import Path

import pytest
from own_file import change, refused, refused_at


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"hinge", "lever"', '"hinge", "lver"', "Revolute 'hinge' is attached to unknown body 'lver'; there are lever"),
        (
            '"lever", (-length / 2, 0.0), GROUND, (0.0, 0.0)',
            '"lever", GROUND, (-length / 2, 0.0), (0.0, 0.0)',
            "Revolute 'hinge': point_i is 'ground', but it must be 2 numbers in brackets, (0.0, 0.0). The order is:",
        ),
        ('"lever.angle", "Angle', '"lever.angel", "Angle', "'lever.angel' is unknown; did you mean 'lever.angle'?"),
        (
            'torque_input("motor", "lever")',
            'torque_input("weight", "lever")',
            "'weight.torque', which does not exist; choose weight.x or weight.y or motor.torque.",
        ),
        ('Torque("motor"', 'Torque("hinge"', "Torque 'hinge' has the name of another part (Revolute)"),
        ('Output("speed"', 'Output("the speed"', "must be of letters, digits and '_'; rename it."),
        (
            'feedthrough=("motor_torque",)',
            'feedthrough=("motor_torque")',
            "feedthrough is 'motor_torque', but it must be a tuple",
        ),
        ('"length", 0.2', '"length", 2e3', "length = 2000 m is above its limit; give at most 1000 m."),
        (
            '"length", 0.2',
            '"length", "0.2"',
            "length: start wants m, got '0.2'; give e.g. 0.5, or with a unit,",
        ),
    ],
)
def test_a_part_that_cannot_be_right_is_told_with_its_line(old: str, new: str, said: str, folder: Path) -> None:
    assert said in refused_at(change(folder, old, new))


def test_a_body_without_mass_is_told_with_its_line(folder: Path) -> None:
    line = change(folder, 'Body("lever", mass,', 'Body("lever", 0,')
    assert refused_at(line) == "Body 'lever': mass = 0 kg, but it must be positive and finite."


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "joints=(hinge,)",
            "joints=(hinge)",
            "Mechanism: joints is a Revolute, but it must be a tuple: write joints=(",
        ),
        ("joints=(hinge,)", "joints=(hinge, weight)", "Mechanism: joints holds Force 'weight', but each entry must be"),
        ('held=("lever.angle",)', 'held=("lever.angle")', "Mechanism: held is a str, but it must be a tuple"),
        ('held=("lever.angle",)', 'held=("lever.phi",)', "choose among lever.x, lever.y, lever.angle."),
        (
            "    return Mechanism(",
            "    Mechanism(",
            "the function of MODEL returns nothing; end it with: return Mechanism(",
        ),
        ('Output("speed"', 'Output("mass"', "Parameter 'mass' has the name of another output; rename one of the two."),
        ('Output("speed"', 'Output("time"', "Output 'time': tables and FMUs have a column of time by that name"),
        ('name="lever"', 'name="my lever"', "'my lever' cannot name an FMU"),
        ('angle="angle"', 'angle="phi"', "Drawing, Bar 'lever': the model has no variable 'phi'"),
        (
            '"Angular speed of the lever", "rad/s"',
            '"rad/s", "Angular speed of the lever"',
            "unit 'Angular speed of the",
        ),
    ],
)
def test_a_mechanism_that_cannot_be_right_is_refused(old: str, new: str, said: str, folder: Path) -> None:
    change(folder, old, new)
    output = refused()
    assert output.startswith("lever.py")
    assert said in output


@pytest.mark.parametrize("flavour", ["pythonfmu", "native"])
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "joints=(hinge,)",
            "joints=(hinge, rod)",
            "The joints cannot be closed from the given start positions. Left open: ",
        ),
        (" START))", " START), start_rate=(1.0, 0.0, 1.0))", "The start rates do not agree with the joints."),
        ("angle=0.0, rest", "angle=1.0, rest", "'lever' is 0.476401 rad beyond its stop on 'ground'"),
    ],
    ids=["open", "rates", "inside"],
)
def test_a_mechanism_that_cannot_start_is_refused(old: str, new: str, said: str, flavour: str, folder: Path) -> None:
    change(folder, 'held=("lever.angle",),', "")
    change(folder, "    weight = ", '    rod = Revolute("rod", "lever", (0.0, 0.0), GROUND, (3.0, 0.0))\n    weight = ')
    change(folder, old, new)
    output = refused("--flavour", flavour)
    assert output.startswith("lever.py: with its default values, the mechanism cannot start. ")
    assert said in output
    assert list((folder / "out").iterdir()) == []
