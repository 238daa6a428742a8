import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from pythonfmu import builder

import build_fmu as command
import models
from mechanism_fmu.fmu.disk.archive import read_entries, with_guid
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError
from tests.fmu.of_every_flavour import OF_EVERY_FLAVOUR

#: What the FMU must run without.
NOT_NEEDED = ("scipy", "fmpy", "typer", "rich", "plotly", "pandas", "markdown_it", "harness", "stress")


@pytest.fixture(scope="module")
def entries(ratchet_fmu: Path) -> dict[str, bytes]:
    return read_entries(ratchet_fmu)


@pytest.fixture(scope="module")
def digest(entries: dict[str, bytes]) -> str:
    """What makes the names of this FMU's modules unlike those of any other."""
    return entries["resources/slavemodule.txt"].decode().removeprefix("Ratchet_")


def test_the_file_is_named_after_the_model(ratchet_fmu: Path) -> None:
    assert ratchet_fmu.name == "Ratchet.fmu"


def test_fmpy_finds_no_problem(ratchet_fmu: Path) -> None:
    assert validate_fmu(str(ratchet_fmu)) == []


def test_nothing_is_inside_that_does_not_belong_there(entries: dict[str, bytes], digest: str) -> None:
    assert re.fullmatch("[0-9a-f]{12}", digest)
    others = {
        name
        for name in entries
        if not name.startswith((f"resources/mechanism_fmu_{digest}/", "resources/pythonfmu/"))
        and not name.endswith(".pyc")
    }
    assert others == {
        "binaries/linux64/Ratchet.so",
        "binaries/win64/Ratchet.dll",
        "documentation/index.html",
        "documentation/licenses/mechanism_fmu.txt",
        "documentation/licenses/pythonfmu.txt",
        "model.png",
        "modelDescription.xml",
        f"resources/Ratchet_{digest}.py",
        f"resources/start_{digest}.py",
        "resources/analysis.json",
        "resources/drawing.json",
        "resources/logic.json",
        "resources/requirements.txt",
        "resources/slavemodule.txt",
        *OF_EVERY_FLAVOUR,
    }
    libraries = {name for name in set(entries) - others if "/engine/compiled/" in name}
    assert {Path(name).name for name in libraries} == {"x86_64-linux.so", "x86_64-windows.dll"}
    sources = {name for name in set(entries) - others - libraries if not name.endswith(".pyc")}
    assert {Path(name).suffix for name in sources} == {".py"}
    compiled = {name for name in entries if name.endswith(".pyc")}
    assert {importlib.util.source_from_cache(name) for name in compiled} < {n for n in entries if n.endswith(".py")}
    assert all(name.endswith(f".{sys.implementation.cache_tag}.pyc") for name in compiled)


def test_the_package_holds_what_runs_and_no_more(entries: dict[str, bytes], digest: str) -> None:
    prefix = f"resources/mechanism_fmu_{digest}/"
    package = {n.removeprefix(prefix) for n in entries if n.startswith(prefix) and not n.endswith(".pyc")}
    assert {name.partition("/")[0] for name in package} == {
        *("__init__.py", "codes.py", "advice.py", "moving.py", "tolerances.py", "units.py"),
        *("elementary", "engine", "fmu", "model", "models", "tables"),
    }
    assert {"fmu/instance/slave.py", "engine/stepping/stepper.py", "models/ratchet/model.py"} <= package
    assert not {"fmu/package.py", "fmu/start.py", "fmu/parts/documentation.py", "fmu/parts/contents.py"} & package
    imports = re.compile(rf"^\s*(from|import) ({'|'.join(NOT_NEEDED)})\b", re.MULTILINE)
    sources = [name for name in package if name.endswith(".py")]
    assert not [name for name in sources if imports.search(entries[prefix + name].decode())]


def test_the_target_must_install_numpy_and_elsewhere_also_numba(entries: dict[str, bytes]) -> None:
    needed, note, elsewhere = entries["resources/requirements.txt"].decode().splitlines()
    assert needed.startswith("numpy>=")
    assert note.startswith("# ")
    assert elsewhere == "# numba<0.69,>=0.68"


def test_the_documentation_says_what_the_wrapper_decides(entries: dict[str, bytes]) -> None:
    page = entries["documentation/index.html"].decode()
    for word in ("fatal", "LD_PRELOAD", "MECHANISM_FMU_CACHE", "Any GUID", "# % + ? &amp;"):
        assert word in page


def test_the_slave_file_defines_no_class(entries: dict[str, bytes], digest: str) -> None:
    text = entries[f"resources/Ratchet_{digest}.py"].decode()
    assert "class" not in text.replace("slave_class", "").partition('"""\n')[2]
    assert len(text.splitlines()) <= 6


def test_the_binaries_have_the_name_that_the_description_gives(ratchet_fmu: Path) -> None:
    description = fmpy.read_model_description(str(ratchet_fmu))
    assert description.coSimulation.modelIdentifier == description.modelName == "Ratchet"


def test_the_icon_is_the_models_own(entries: dict[str, bytes]) -> None:
    assert entries["model.png"] == (models.available()["ratchet"] / "model.png").read_bytes()


def test_what_this_process_has_run_changes_no_byte(ratchet_fmu: Path, tmp_path: Path) -> None:
    """Such as modules that only a run imports."""
    fmpy.simulate_fmu(str(ratchet_fmu), stop_time=0.01)
    again = build_fmu(models.load("ratchet"), tmp_path)
    assert again.read_bytes() == ratchet_fmu.read_bytes()
    fmpy.simulate_fmu(str(again), stop_time=0.01)  # by the modules that were there before


def test_the_guid_is_a_fingerprint_of_the_contents(entries: dict[str, bytes]) -> None:
    # Reference results and compiled sources follow from the rest.
    follows = ("extra/", ".pyc")
    contents = {
        name: data for name, data in entries.items() if not (name.startswith(follows) or name.endswith(follows))
    }
    assert with_guid(contents) == contents
    changed = with_guid(contents | {"model.png": b"another"})
    assert changed["modelDescription.xml"] != entries["modelDescription.xml"]


def test_the_archive_is_sorted_and_without_a_trace_of_when_and_where(ratchet_fmu: Path) -> None:
    with zipfile.ZipFile(ratchet_fmu) as archive:
        infos = archive.infolist()
    assert [i.filename for i in infos] == sorted(i.filename for i in infos)
    assert {i.date_time for i in infos} == {(1980, 1, 1, 0, 0, 0)}
    assert {oct(i.external_attr >> 16) for i in infos} == {"0o100644", "0o100755"}
    assert [i.filename for i in infos if i.external_attr >> 16 == 0o100755] == [
        *("binaries/linux64/Ratchet.so", "binaries/win64/Ratchet.dll"),
    ]


def test_the_command_gives_the_same_bytes_elsewhere(ratchet_fmu: Path, tmp_path: Path) -> None:
    for name in ("cwd", "tmp"):
        (tmp_path / name).mkdir()
    script = Path(command.__file__).resolve()
    environment = os.environ | {
        "TMPDIR": str(tmp_path / "tmp"),
        "PYTHONPATH": str(script.parent),
        "PYTHONHASHSEED": "7",
    }
    done = subprocess.run(
        [sys.executable, str(script), "ratchet", "-o", "new/folder"],
        cwd=tmp_path / "cwd",
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    again = tmp_path / "cwd" / "new" / "folder" / "Ratchet.fmu"
    assert again.read_bytes() == ratchet_fmu.read_bytes()
    guid = fmpy.read_model_description(str(again)).guid
    assert done.stdout.startswith(os.path.join("new", "folder", "Ratchet.fmu"))
    assert guid in done.stdout
    assert list((tmp_path / "tmp").iterdir()) == []


def test_a_build_leaves_the_imports_of_its_process_as_they_were(ratchet_fmu: Path, digest: str, tmp_path: Path) -> None:
    path = sys.path[:]
    ours = {name for name in sys.modules if digest in name}
    assert build_fmu(models.load("ratchet"), tmp_path).read_bytes() == ratchet_fmu.read_bytes()
    assert sys.path == path
    assert {name for name in sys.modules if digest in name} == ours


def test_many_instantiations_leave_the_host_as_it_was(ratchet_fmu: Path, digest: str) -> None:
    # In a process of its own, because the failure would be a crash.
    code = f"""
import sys, fmpy
from fmpy.fmi2 import FMU2Slave
folder = fmpy.extract({str(ratchet_fmu)!r})
description = fmpy.read_model_description(folder)
before = sys.path[:]
references = set()
for i in range(50):
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier="Ratchet", instanceName="one")
    fmu.instantiate()
    references.add(sys.getrefcount(sys.modules["Ratchet_{digest}"].__dict__))
    fmu.fmi2FreeInstance(fmu.component)
assert len(references) == 1, references
assert sys.path[1:] == before, sys.path
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_clock_before_the_first_year_of_zip_archives_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As of a machine without a battery."""
    monkeypatch.setattr("time.localtime", lambda *_: time.gmtime(200_000_000))
    with pytest.raises(MechanismError, match="archives begin with 1980; set the clock, or build with"):
        build_fmu(models.load("motor"), tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_all_that_is_temporary_lies_in_one_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So that it goes with the next one if the process is killed (mechanism_fmu.fmu.disk.folders)."""
    seen: list[list[str]] = []
    usual = builder.get_model_description

    def looking(*given: object) -> object:
        seen.append([path.name for path in temporary.iterdir()])
        return usual(*given)

    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    monkeypatch.setattr(builder, "get_model_description", looking)
    build_fmu(models.load("motor"), tmp_path)
    assert [[name.rpartition("-")[0] for name in names] for names in seen] == [[f"mechanism-fmu-{os.getpid()}"]]
    assert list(temporary.iterdir()) == []
    assert tempfile.tempdir == str(temporary)
