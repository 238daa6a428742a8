"""The mistakes that a user's file can have, each through the real command: what is said, and the exit code."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from harness.cli import main
from mechanism_fmu.fmu.own.new import write_new


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write_new("lever", tmp_path)
    return tmp_path


def build(*arguments: str, of: str = "lever.py") -> tuple[int, str]:
    result = CliRunner().invoke(main, ["build", of, "-o", "out", *arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert "Traceback" not in result.output
    return result.exit_code, " ".join(result.stderr.split())


def change(folder: Path, old: str, new: str) -> int:
    """Change the file, and tell the line."""
    path = folder / "lever.py"
    text = path.read_text()
    assert text.count(old) == 1, old
    path.write_text(text.replace(old, new))
    return text[: text.index(old)].count("\n") + 1


# --- which file ------------------------------------------------------------------------------------------------------


def test_a_file_that_does_not_exist_is_wrong_use_and_a_near_name_is_offered() -> None:
    assert build(of="leverr.py") == (2, "There is no file leverr.py; did you mean lever.py?")
    assert build(of="other/lever.py") == (2, "There is no file other/lever.py, nor a folder other; check the path.")
    code, said = build(of="zzz.py")
    assert (code, said) == (
        2,
        "There is no file zzz.py; Python files there: lever.py. "
        "A new one is written by: mechanism-fmu new my_mechanism",
    )


def test_the_name_of_a_file_without_py_is_no_model() -> None:
    code, said = build(of="lever")
    assert code == 2
    assert said.endswith("For a mechanism of your own, give its file, e.g. lever.py.")


def test_a_folder_is_wrong_use(folder: Path) -> None:
    code, said = build(of=str(folder))
    assert code == 2
    assert f"{folder} is a folder; give the file in it that sets MODEL (Python files there: lever.py)." in said


def test_another_kind_of_file_is_wrong_use(folder: Path) -> None:
    (folder / "lever.txt").write_text("")
    assert build(of="lever.txt")[0] == 2
    assert "lever.txt is not a Python file" in build(of="lever.txt")[1]


def test_a_file_name_that_cannot_travel_is_wrong_use(folder: Path) -> None:
    (folder / "lever.py").rename(folder / "hebel.größe.py")
    code, said = build(of="hebel.größe.py")
    assert code == 2
    assert "rename it, for example to hebel_gr_e.py." in said


# --- what is in it ---------------------------------------------------------------------------------------------------


def test_a_syntax_error_is_told_with_its_line(folder: Path) -> None:
    line = change(folder, "    return Mechanism(\n", "    return = Mechanism(\n")
    code, said = build()
    assert code == 1
    assert said == f"lever.py, line {line} (return = Mechanism(): this is no Python: invalid syntax."


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = 1\n", "lever.py: it sets no MODEL; end the file with MODEL = Model("),
        ("from mechanism_fmu.model import *\nMODEL = Mechanism((Body('a', 1, 1),))\n", "MODEL is of type Mechanism"),
        (
            "from mechanism_fmu.model import *\nmodel = Model('A', '', (), None)\n",
            "lever.py: it sets no MODEL, but model is a Model: name it MODEL.",
        ),
    ],
    ids=["none", "a mechanism", "another name"],
)
def test_a_file_without_a_model_is_refused(text: str, said: str, folder: Path) -> None:
    (folder / "lever.py").write_text(text)
    code, output = build()
    assert code == 1
    assert said in output


def test_a_file_that_is_not_in_utf8_is_refused(folder: Path) -> None:
    (folder / "lever.py").write_bytes("# größer\n".encode("latin-1"))
    assert build() == (1, "lever.py: the file is not in UTF-8; save it in that encoding.")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("import pandaz", "there is no package 'pandaz' in this Python."),
        ("import parts", "there is no module 'parts', but a file parts.py beside it: write 'from .parts import ...'."),
        ("from .prats import A", "there is no file prats.py beside it."),
        ("from mechanism_fmu.model import Damperr", "mechanism_fmu.model has no 'Damperr'; did you mean 'Damper'?"),
        ("import mechanism_fmu.joints", "write 'from mechanism_fmu.model import ...', where all parts are."),
        ("import pytest", "the model imports pytest, which mechanism_fmu does not depend on;"),
        ("import mechanism_fmu.model as m", "write 'from mechanism_fmu.model import ...' on one line"),
    ],
)
def test_an_import_that_fails_or_cannot_travel_is_told_with_its_line(line: str, said: str, folder: Path) -> None:
    (folder / "parts.py").write_text("A = 1\n")
    number = change(folder, "from math import radians", line + "\nfrom math import radians")
    code, output = build()
    assert code == 1
    assert output.startswith(f"lever.py, line {number}: ")
    assert said in output


def test_numpy_may_be_imported(folder: Path) -> None:
    change(folder, "from math import radians", "import numpy.random\nfrom math import radians")
    assert build()[0] == 0


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('Force("weight"', 'Forse("weight"', "the name 'Forse' is not defined; did you mean 'Force'?"),
        (
            'Torque("motor", "lever")',
            'Damper("motor", "lever")',
            "Damper is not imported; write: from mechanism_fmu.model import Damper.",
        ),
        (
            'AngleStop("stop", "lever", GROUND, angle=0.0',
            'AngleStop("stop", "lever", GROUND, angel=0.0',
            "AngleStop got an unexpected keyword argument 'angel'; did you mean 'angle'? It takes name, body_i,",
        ),
        (
            "values.mass, values.length",
            "values.mass, values.lenght",
            "there is no parameter 'lenght'; did you mean 'length'? There are: length, mass, bounce.",
        ),
        ("-9.81 * mass", "-9.81 * mass / 0", "ZeroDivisionError: "),
        ("radians(30)", "exit()", "the file ends Python (exit); remove that."),
    ],
)
def test_an_exception_of_the_file_is_told_with_its_line(old: str, new: str, said: str, folder: Path) -> None:
    line = change(folder, old, new)
    code, output = build()
    assert code == 1
    assert output.startswith(f"lever.py, line {line}: {said}")


def test_a_data_file_does_not_travel_by_pythonfmu(folder: Path) -> None:
    (folder / "start.csv").write_text("0.5")
    line = change(
        folder, "radians(30)", "float(__import__('pathlib').Path(__file__).with_name('start.csv').read_text())"
    )
    code, said = build()
    assert code == 1
    assert said.startswith(
        f"lever.py, line {line}: in the FMU, where the file runs again from another folder, it raises"
    )
    assert build("--flavour", "native")[0] == 0


def test_arguments_that_are_missing_are_named(folder: Path) -> None:
    change(folder, '"lever", mass, inertia, start=(0.0, 0.0, START)', '"lever", mass')
    code, said = build()
    assert code == 1
    assert "Body missing 1 required positional argument: 'inertia'. It takes name, mass, inertia, start," in said


# --- the mechanism ---------------------------------------------------------------------------------------------------


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
        ('"length", 0.2', '"length", "0.2"', "Parameter 'length': start is '0.2', but it must be a number."),
    ],
)
def test_a_part_that_cannot_be_right_is_told_with_its_line(old: str, new: str, said: str, folder: Path) -> None:
    line = change(folder, old, new)
    code, output = build()
    assert code == 1
    assert output.startswith(f"lever.py, line {line}: ")
    assert said in output


def test_a_body_without_mass_is_told_with_its_line(folder: Path) -> None:
    line = change(folder, 'Body("lever", mass,', 'Body("lever", 0,')
    code, said = build()
    assert code == 1
    assert said == f"lever.py, line {line}: Body 'lever': mass = 0 kg, but it must be positive and finite."


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
    code, output = build()
    assert code == 1
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
    code, output = build("--flavour", flavour)
    assert code == 1
    assert output.startswith("lever.py: with its default values, the mechanism cannot start. ")
    assert said in output
    assert list((folder / "out").iterdir()) == []


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("    weight = ", "    if values.mass > 1: pass\n    weight = ", "must not branch on a parameter"),
        (
            "/ 12  #",
            "/ 12 * __import__('math').exp(0 * mass)  #",
            "must not branch on a parameter, compare it, or turn it into",
        ),
        ("length * length", "length**2", "must not use **, // or % on a parameter"),
    ],
)
def test_what_cannot_be_traced_is_refused_for_native_and_a_warning_for_pythonfmu(
    old: str, new: str, said: str, folder: Path
) -> None:
    line = change(folder, old, new)
    code, output = build("--flavour", "native")
    assert code == 1
    assert f"lever cannot be traced, lever.py, line {line} " in output
    assert said in output
    code, output = build()
    assert code == 0
    assert output.startswith("Warning: lever.py: as it is, it cannot be built with --flavour native.")
    assert said in output


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "radians(30)",
            "30",
            "Body 'lever': its start angle is 30 rad, more than a turn. Angles are in radians: if you",
        ),
        ("angle=0.0, rest", "angle=-90, rest", "AngleStop 'stop': its angle is -90 rad, more than a turn."),
        ('"rad", "deg")', '"deg")', "angle has the unit 'deg', but the mechanism calculates in SI units"),
        (
            '"Speed after an impact, as a fraction of the speed before"',
            '"m"',
            "bounce has the description 'm', which looks like a unit",
        ),
    ],
)
def test_what_looks_like_a_mistake_is_a_warning(old: str, new: str, said: str, folder: Path) -> None:
    change(folder, old, new)
    code, output = build()
    assert code == 0
    assert f"Warning: lever.py: {said}" in output


def test_a_destination_that_is_no_folder_is_not_blamed_on_the_file() -> None:
    result = CliRunner().invoke(main, ["build", "lever.py", "-o", "x.fmu"])
    assert result.exit_code == 1
    assert result.stderr.startswith("x.fmu is not a folder; give the folder for lever.fmu")


# --- a new file ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["my-lever", "2nd", "class", "größe", "a/b", ""])
def test_a_new_mechanism_needs_a_name_that_an_fmu_can_have(name: str, folder: Path) -> None:
    result = CliRunner().invoke(main, ["new", name])
    assert result.exit_code == 2
    assert f"{name!r} cannot name an FMU; use the letters a to z" in result.stderr
    better = result.stderr.split()[-1]
    assert CliRunner().invoke(main, ["new", better]).exit_code == 0
    assert (folder / f"{better}.py").is_file()


def test_a_file_that_is_there_already_is_kept(folder: Path) -> None:
    (folder / "lever.py").write_text("mine")
    for name in ("lever", "lever.py"):
        result = CliRunner().invoke(main, ["new", name])
        assert result.exit_code == 2
        assert "lever.py is there already" in result.stderr
    assert (folder / "lever.py").read_text() == "mine"
