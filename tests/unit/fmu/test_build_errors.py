import importlib.util
import os
import zipfile
from pathlib import Path
from types import ModuleType

import pytest
import typer
from typer.testing import CliRunner

import build_fmu as command
import models
from mechanism_fmu.fmu.disk.archive import content_hash, read_entries, write_archive
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError

GOOD = "from mechanism_fmu.model import Mechanism, Model\nMODEL = Model({name!r}, '', (), lambda _: Mechanism(()))\n"


def module(folder: Path, text: str) -> ModuleType:
    path = folder / "model.py"
    path.write_text(text)
    spec = importlib.util.spec_from_file_location("zoo.thing.model", path)
    assert spec is not None
    assert spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def test_a_module_without_a_model_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MechanismError, match=r"zoo\.thing\.model holds no model; it must set MODEL"):
        build_fmu(module(tmp_path, "x = 1\n"), tmp_path)


@pytest.mark.parametrize("name", ["My model", "2nd", "", "class", "Rätsche"])
def test_a_name_that_cannot_be_a_file_and_a_class_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(MechanismError, match="cannot name an FMU"):
        build_fmu(module(tmp_path, GOOD.format(name=name)), tmp_path)


def test_an_import_that_an_fmu_cannot_ask_for_is_refused(tmp_path: Path) -> None:
    good = module(tmp_path, GOOD.format(name="Thing"))
    (tmp_path / "model.py").write_text("import casadi\n" + GOOD.format(name="Thing"))
    with pytest.raises(MechanismError, match="imports casadi"):
        build_fmu(good, tmp_path / "out")


def test_the_destination_is_a_folder_and_not_the_file(tmp_path: Path) -> None:
    thing = module(tmp_path, GOOD.format(name="Thing"))
    for destination in (tmp_path / "other.fmu", tmp_path / "model.py"):
        with pytest.raises(MechanismError, match=r"give the folder for Thing\.fmu"):
            build_fmu(thing, destination)


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "Thing.fmu"
    path.write_bytes(b"old")
    with pytest.raises(TypeError):
        write_archive({"a": b"fine", "b": None}, path)  # type: ignore[dict-item]
    assert [p.name for p in tmp_path.iterdir()] == ["Thing.fmu"]
    assert path.read_bytes() == b"old"


@pytest.mark.parametrize("compressed", [False, True])
def test_an_archive_has_what_was_put_in_whatever_it_is(compressed: bool, tmp_path: Path) -> None:
    entries = {"empty": b"", "one": b"x", "zeros": bytes(100_000), "binaries/ü/noise": os.urandom(70_000)}
    path = tmp_path / "Thing.fmu"
    write_archive(entries, path, compressed=compressed)
    assert read_entries(path) == entries
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
    assert (path.stat().st_size < 80_000) == compressed


def test_the_content_hash_tells_names_and_contents_apart() -> None:
    hashes = [content_hash(files) for files in ({"a": b"bc"}, {"ab": b"c"}, {"a": b"b", "c": b""}, {})]
    assert len(set(hashes)) == 4
    assert content_hash({"a": b"1", "b": b"2"}) == content_hash({"b": b"2", "a": b"1"})


APP = typer.Typer()
APP.command()(command.build)

OWN = "For a mechanism of your own, give its file, e.g. my_mechanism.py."
MODELS = ", ".join(models.available())


def test_an_unknown_model_is_answered_with_the_list() -> None:
    result = CliRunner().invoke(APP, ["rachet"])
    assert result.exit_code == 2
    assert result.stderr == f"There is no model 'rachet'; there are: {MODELS}. {OWN}\n"
    assert result.stdout == ""


def test_no_model_is_answered_with_the_list() -> None:
    result = CliRunner().invoke(APP, [])
    assert (result.exit_code, result.stderr) == (2, f"Say which model to build; there are: {MODELS}. {OWN}\n")


def test_the_list_describes_the_models() -> None:
    result = CliRunner().invoke(APP, ["--list"])
    assert result.exit_code == 0
    assert models.load("ratchet").MODEL.description in result.stdout


def test_a_refusal_is_a_message_and_an_exit_code(tmp_path: Path) -> None:
    result = CliRunner().invoke(APP, ["ratchet", "-o", str(tmp_path / "x.fmu")])
    assert result.exit_code == 1
    assert result.stderr.startswith(f"{tmp_path / 'x.fmu'} is not a folder")


def test_help_shows_an_example() -> None:
    assert "build_fmu.py ratchet -o build/" in CliRunner().invoke(APP, ["--help"]).stdout


def test_an_unknown_model_is_refused_by_the_loader() -> None:
    with pytest.raises(MechanismError, match=r"'rachet'; there are: .*ratchet"):
        models.load("rachet")


def test_every_model_folder_holds_a_model() -> None:
    assert all((folder / "model.py").is_file() for folder in models.available().values())
    assert {models.load(name).MODEL.name for name in models.available()} >= {"Ratchet"}
