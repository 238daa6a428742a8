"""Which FMUs have a fast path for many designs, and that it runs the model and the library that it should."""

import threading
import zlib
from pathlib import Path

import numpy as np
import pytest

from mechanism_fmu.batch import Batch, NoBatchError
from mechanism_fmu.fmu.disk.archive import read_entries, write_archive


@pytest.fixture(scope="module")
def cams(cam_drive_fmu: Path) -> Batch:
    return Batch.of_fmu(cam_drive_fmu)


def test_an_fmu_without_python_has_no_fast_path(native_ratchet_fmu):
    with pytest.raises(NoBatchError, match="holds no Python model"):
        Batch.of_fmu(native_ratchet_fmu)


def test_what_is_no_fmu_has_no_fast_path(tmp_path):
    (tmp_path / "x.fmu").write_text("x")
    for name in ("x.fmu", "y.fmu"):
        with pytest.raises(NoBatchError, match="cannot be read as an FMU"):
            Batch.of_fmu(tmp_path / name)


def test_an_fmu_of_another_engine_has_no_fast_path(ratchet_fmu, tmp_path):
    entries = read_entries(ratchet_fmu)
    name = next(name for name in entries if name.endswith("/engine/stepping/step.py"))
    write_archive(entries | {name: entries[name] + b"\n"}, tmp_path / "Ratchet.fmu")
    with pytest.raises(NoBatchError, match=r"another state of mechanism_fmu \(engine/stepping/step.py"):
        Batch.of_fmu(tmp_path / "Ratchet.fmu")


def rewritten(ratchet_fmu: Path, folder: Path, name: str, old: bytes, new: bytes) -> Path:
    """A ratchet with a change in a file of its model."""
    entries = read_entries(ratchet_fmu)
    package = next(name for name in entries if name.endswith("/models/ratchet/ports.py")).split("/")[1]
    other = f"mechanism_fmu_{zlib.crc32(new):012x}"
    changed = {
        name.replace(package, other): data.replace(package.encode(), other.encode()) for name, data in entries.items()
    }
    name = f"resources/{other}/models/ratchet/{name}"
    assert old in changed[name]
    changed[name] = changed[name].replace(old, new)
    write_archive(changed, folder / "Ratchet.fmu")
    return folder / "Ratchet.fmu"


def test_the_model_is_the_one_in_the_fmu(ratchet_fmu, tmp_path):
    """Not the one of the same name that lies here."""
    other = Batch.of_fmu(rewritten(ratchet_fmu, tmp_path, "ports.py", b"5.6264", b"9.0"))
    found = other.run({"friction": [0.0]}, [0.0, 1.0], ["impact_time"])
    assert found.compiled == "ahead of time"
    heavier = Batch.of_fmu(ratchet_fmu).run({"wheel_mass": [9.0]}, [0.0, 1.0], ["impact_time"])
    assert found.values["impact_time"].tolist() == heavier.values["impact_time"].tolist()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b"MODEL = Model(", b"import no_such_package\nMODEL = Model(", "cannot be imported here: No module named"),
        (b"    mechanism=mechanism,", b"    mechanism=lambda v: mechanism(v) if v.guided > 0 else None,", "traced"),
    ],
)
def test_a_model_that_cannot_be_used_is_told(ratchet_fmu, tmp_path, old, new, message):
    with pytest.raises(NoBatchError, match=message):
        Batch.of_fmu(rewritten(ratchet_fmu, tmp_path, "model.py", old, new))


@pytest.mark.parametrize("threads", [1, 2])
def test_designs_run_in_the_compiled_library_and_nowhere_else(cams, monkeypatch, threads):
    """One call of it in each thread takes them all; that the numbers are right would not show who made them."""
    library = cams._engine
    assert library is not None
    calls = []

    class Counted:
        def __getattr__(self, name):
            return getattr(library, name)

        def engine_many(self, job, block):
            calls.append(name_of_thread())
            return library.engine_many(job, block)

    def never(*_):
        raise AssertionError("a design ran outside the library")

    monkeypatch.setitem(vars(cams), "_engine", Counted())
    monkeypatch.setattr("mechanism_fmu.batch.workers._one_by_one", never)
    monkeypatch.setattr("mechanism_fmu.batch.workers.OneByOne.run", never)
    found = cams.run({"cam_speed_start": np.linspace(40.0, 50.0, 6)}, [0.0, 0.01], threads=threads)
    assert found.failures == ("",) * 6
    assert found.compiled == "ahead of time"
    assert len(calls) == threads
    assert "MainThread" not in calls


def name_of_thread():
    return threading.current_thread().name
