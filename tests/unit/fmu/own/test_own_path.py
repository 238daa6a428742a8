"""Which file a user may name to be built, and where to."""

from pathlib import Path

from own_file import wrong_use
from typer.testing import CliRunner

from harness.app.cli import main


def test_a_file_that_does_not_exist_is_wrong_use_and_a_near_name_is_offered() -> None:
    assert wrong_use("leverr.py") == "There is no file leverr.py; did you mean lever.py?"
    assert wrong_use("other/lever.py") == "There is no file other/lever.py, nor a folder other; check the path."
    assert wrong_use("zzz.py") == (
        "There is no file zzz.py; Python files there: lever.py. A new one is written by: mechanism-fmu new my_mechanism"
    )


def test_the_name_of_a_file_without_py_is_no_model() -> None:
    assert wrong_use("lever").endswith("For a mechanism of your own, give its file, e.g. lever.py.")


def test_a_folder_is_wrong_use(folder: Path) -> None:
    said = wrong_use(str(folder))
    assert f"{folder} is a folder; give the file in it that sets MODEL (Python files there: lever.py)." in said


def test_another_kind_of_file_is_wrong_use(folder: Path) -> None:
    (folder / "lever.txt").write_text("")
    assert "lever.txt is not a Python file" in wrong_use("lever.txt")


def test_a_file_name_that_cannot_travel_is_wrong_use(folder: Path) -> None:
    (folder / "lever.py").rename(folder / "hebel.größe.py")
    assert "rename it, for example to hebel_gr_e.py." in wrong_use("hebel.größe.py")


def test_a_destination_that_is_no_folder_is_not_blamed_on_the_file(new_folder: Path) -> None:
    result = CliRunner().invoke(main, ["build", "lever.py", "-o", "x.fmu"])
    assert result.exit_code == 1
    assert result.stderr.startswith("x.fmu is not a folder; give the folder for lever.fmu")
