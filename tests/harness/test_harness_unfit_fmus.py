"""What is said of FMUs that cannot be run, or not as they are: each message names what is there, and what to do."""

import zipfile
from collections.abc import Callable
from pathlib import Path

import fmpy
import pytest

from harness.errors import FmuError, UsageError
from harness.fmu import open_fmu
from harness.fmu.description_file import read_description
from tests.harness.machine.foreign import in_c
from tests.once import once


@pytest.fixture(scope="module")
def pulse(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 3.0, in C, with clocks."""
    pytest.importorskip("ziglang")
    return once(tmp_path_factory, "foreign_pulse", in_c.pulse) / "Pulse.fmu"


def changed(fmu: Path, path: Path, change: Callable[[str, bytes], tuple[str, bytes] | None]) -> Path:
    """An FMU whose files have other names or contents, or are left out."""
    with zipfile.ZipFile(fmu) as given, zipfile.ZipFile(path, "w") as made:
        for name in given.namelist():
            entry = change(name, given.read(name))
            if entry is not None:
                made.writestr(*entry)
    return path


def with_xml(fmu: Path, path: Path, old: str, new: str) -> Path:
    """An FMU with another text in its modelDescription.xml."""

    def change(name: str, data: bytes) -> tuple[str, bytes]:
        if name != "modelDescription.xml":
            return name, data
        text = data.decode()
        assert old in text
        return name, text.replace(old, new).encode()

    return changed(fmu, path, change)


def test_another_interface_is_named(pulse: Path, tmp_path: Path) -> None:
    path = with_xml(pulse, tmp_path / "other.fmu", "<CoSimulation ", "<ScheduledExecution ")
    with pytest.raises(UsageError, match=r"it has Scheduled Execution only, of FMI 3\.0\. .*; export it again\."):
        read_description(path)
    with pytest.raises(UsageError, match=r"is not an FMU for Model Exchange .*: it has Co-Simulation only"):
        read_description(pulse, exchange=True)


def test_a_library_of_another_name_is_named(pulse: Path, tmp_path: Path) -> None:
    path = changed(pulse, tmp_path / "renamed.fmu", lambda name, data: (name.replace("/pulse", "/libpulse"), data))
    file = f"{fmpy.platform_tuple}/libpulse{fmpy.sharedLibraryExtension}"
    with (
        pytest.raises(UsageError, match=rf"names its library pulse \(modelIdentifier\), .*there is {file}: .*/pulse\."),
        open_fmu(path),
    ):
        pass


def test_libraries_of_other_platforms_are_listed(pulse: Path, tmp_path: Path) -> None:
    path = tmp_path / "far.fmu"
    changed(pulse, path, lambda name, data: (name.replace(fmpy.platform_tuple, "riscv64-linux"), data))
    with zipfile.ZipFile(path, "a") as fmu:
        fmu.writestr("binaries/sparc64-solaris/pulse.so", b"")
    there = r"its libraries: riscv64-linux/pulse\.\w+, sparc64-solaris/pulse\.so\. .*ask whoever made it"
    with pytest.raises(UsageError, match=rf"no library for {fmpy.platform_tuple}; {there}"), open_fmu(path):
        pass


def test_sources_alone_are_to_be_compiled(pulse: Path, tmp_path: Path) -> None:
    path = changed(pulse, tmp_path / "c.fmu", lambda name, data: None if name.startswith("binaries") else (name, data))
    with zipfile.ZipFile(path, "a") as fmu:
        fmu.writestr("sources/pulse.c", b"")
    with (
        pytest.raises(UsageError, match=r"its libraries: none\. For one that runs here, compile its sources"),
        open_fmu(path),
    ):
        pass


def test_a_library_that_cannot_be_loaded_is_told_with_those_that_are_there(pulse: Path, tmp_path: Path) -> None:
    path = changed(pulse, tmp_path / "broken.fmu", lambda name, data: (name, data if "xml" in name else b"no library"))
    there = rf"the FMU has {fmpy.platform_tuple}/pulse\.\w+"
    with (
        open_fmu(path) as fmu,
        pytest.raises(FmuError, match=rf"its library cannot be loaded; .*{there}"),
        fmu.instantiate("one"),
    ):
        pass


def test_clocks_that_tick_by_time_are_refused(pulse: Path, tmp_path: Path) -> None:
    old = 'name="poke" valueReference="5" causality="input" intervalVariability="triggered"'
    new = 'name="poke" valueReference="5" causality="input" intervalVariability="constant" intervalDecimal="0.1"'
    path = with_xml(pulse, tmp_path / "timed.fmu", old, new)
    with (
        open_fmu(path) as fmu,
        pytest.raises(UsageError, match=r"input clock poke, which ticks by time \(intervalVariability = constant\)"),
        fmu.instantiate("one"),
    ):
        pass
