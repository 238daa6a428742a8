"""A user's file that Python cannot run, or that does not set a model: what is said, and of which line."""

from pathlib import Path

import pytest
from own_file import built, change, refused, refused_at


def test_a_syntax_error_is_told_with_its_line(folder: Path) -> None:
    line = change(folder, "    return Mechanism(\n", "    return = Mechanism(\n")
    assert refused() == f"lever.py, line {line} (return = Mechanism(): this is no Python: invalid syntax."


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
    assert said in refused()


def test_a_file_that_is_not_in_utf8_is_refused(folder: Path) -> None:
    (folder / "lever.py").write_bytes("# größer\n".encode("latin-1"))
    assert refused() == "lever.py: the file is not in UTF-8; save it in that encoding."


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
    assert said in refused_at(number)


def test_numpy_may_be_imported(folder: Path) -> None:
    change(folder, "from math import radians", "import numpy.random\nfrom math import radians")
    built()


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
        (
            "length / 12",
            "length / 12 + torque_input('motor', 'lever', 0.0, 1.0)",
            "torque_input takes from 2 to 3 positional arguments but 4 were given. It takes force, body, start, usual.",
        ),
        ("-9.81 * mass", "-9.81 * mass / 0", "ZeroDivisionError: "),
        ("radians(30)", "exit()", "the file ends Python (exit); remove that."),
    ],
)
def test_an_exception_of_the_file_is_told_with_its_line(old: str, new: str, said: str, folder: Path) -> None:
    assert refused_at(change(folder, old, new)).startswith(said)


def test_a_data_file_does_not_travel_by_pythonfmu(folder: Path) -> None:
    (folder / "start.csv").write_text("0.5")
    line = change(
        folder, "radians(30)", "float(__import__('pathlib').Path(__file__).with_name('start.csv').read_text())"
    )
    assert refused_at(line).startswith("in the FMU, where the file runs again from another folder, it raises")
    built("--flavour", "native")


def test_arguments_that_are_missing_are_named(folder: Path) -> None:
    change(folder, '"lever", mass, inertia, start=(0.0, 0.0, START)', '"lever", mass')
    assert "Body missing 1 required positional argument: 'inertia'. It takes name, mass, inertia, start," in refused()
