"""The new form in a user's file: the template, what is refused with its line, and the remark on the old form."""

from pathlib import Path

import pytest
from own_file import built, change, refused, refused_at
from typer.testing import CliRunner

from harness.app.cli import main


def test_the_template_is_built_without_a_remark(new_folder: Path) -> None:
    assert built() == ""
    assert built("--flavour", "native") == ""


def test_the_old_form_is_built_with_a_remark_on_its_first_line(folder: Path) -> None:
    text = (folder / "lever.py").read_text()
    line = text[: text.index('Revolute("hinge"')].count("\n") + 1
    said = CliRunner().invoke(main, ["build", "lever.py", "-o", "out"])
    assert " ".join(said.stderr.split()) == (
        f"Warning: lever.py: line {line}: Revolute 'hinge' is written in the old form, with points and numbers by "
        "position, which goes after the next version; write Revolute(name, body_i.at(x, y), body_j.at(x, y), ...=...). "
        "So are 1 more."
    )


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"hinge", lever.a,', '"hinge", "lever",', "Revolute 'hinge' takes a point of 'lever'; write body_i.at(x, y),"),
        ('"motor", lever)', '"motor", lever.a)', "Torque 'motor' is attached to 'lever' as a whole, not to a point of"),
        ("GROUND.at(0, 0))", "GROUND.at(0, 0), 0.1)", "Revolute takes name, body_i, body_j by position, but 4 were "
         "given; give what is behind the ends by keyword. It takes name, body_i, body_j, friction_radius, "
         "friction_static."),
        ('AngleStop("stop", lever, GROUND, angle=0.0', 'AngleStop("stop", lever, GROUND, angel=0.0', "AngleStop got an "
         "unexpected keyword argument 'angel'; did you mean 'angle'? It takes name, body_i, body_j, angle,"),
        ("GROUND.at(0, 0))", "(0, 0))", "Revolute 'hinge' takes a point of a body there, but (0, 0) was given; "),
        ("mass=values.mass)", "mass=0.0)", "Body 'lever': mass = 0 kg, but it must be positive and finite."),
        ("angle=0.0,", 'angle="5 mm",', "AngleStop 'stop': angle wants rad, got '5 mm'; give e.g. 0.5, or with a unit"),
        ("mass=values.mass)", 'mass="5 mm")', "bar 'lever': mass wants kg, got '5 mm'"),
        ("mass=values.mass)", "mas=values.mass)", "bar got an unexpected keyword argument 'mas'; did you mean 'mass'?"),
        ('"200 mm"', '"200 kg"', "length: start wants m, got '200 kg'; give e.g. 0.5, or with a unit, '0.5 m'."),
        ("torque_input(\"motor\", \"lever\")", "constant('a')", "Term: coefficient 0 of the polynomial is 'a', but"),
    ],
)  # fmt: skip
def test_a_mistake_is_said_with_its_line(old: str, new: str, said: str, new_folder: Path) -> None:
    if "constant" in new:
        change(new_folder, "import GROUND,", "import constant, GROUND,")
    assert refused_at(change(new_folder, old, new)).startswith(said)


def test_an_if_on_a_parameter_is_said_with_its_line_and_the_way_out_in_both_flavours(new_folder: Path) -> None:
    """By pythonfmu it still runs, and the build says that it will not do as a native FMU."""
    line = change(new_folder, "    lever = bar(", "    if values.length > 0.1: pass\n    lever = bar(")
    said = f"lever cannot be traced, lever.py, line {line} (if values.length > 0.1: pass): "
    way_out = "choose between values with where_positive"
    assert said in (native := refused("--flavour", "native"))
    assert way_out in native
    assert said in (python := built())
    assert way_out in python
