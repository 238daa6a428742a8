"""What is in the file of a native FMU, and that the same sources give the same bytes."""

import struct
import zipfile

import fmpy
import pytest
from fmpy.validation import validate_fmu
from typer.testing import CliRunner

import models
from harness.app.cli import main
from mechanism_fmu.fmu.disk.archive import read_entries
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.fmu.of_every_flavour import OF_EVERY_FLAVOUR

FOLDERS = {
    2: {"linux64": ".so", "win64": ".dll", "darwin64": ".dylib", "aarch64-linux": ".so"},
    3: {
        "x86_64-linux": ".so",
        "x86_64-windows": ".dll",
        "x86_64-darwin": ".dylib",
        "aarch64-linux": ".so",
        "aarch64-darwin": ".dylib",
    },
}
#: First bytes of a library, and where its processor stands: (magic, offset of the code or of its pointer, codes).
ELF, MACH_O, UNIVERSAL, PE = b"\x7fELF", b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe", b"MZ"


@pytest.fixture(params=[2, 3])
def fmi(request):
    return request.param


@pytest.fixture
def fmu(request, fmi):
    return request.getfixturevalue("native_ratchet_fmu" if fmi == 2 else "ratchet_fmi3")


def processor(library):
    """The processor that a shared library is for, from its file format's header."""
    if library.startswith(ELF):
        return {62: "x86_64", 183: "aarch64"}[struct.unpack_from("<H", library, 18)[0]]
    if library.startswith(MACH_O):
        return {0x01000007: "x86_64", 0x0100000C: "aarch64"}[struct.unpack_from("<I", library, 4)[0]]
    assert library.startswith(PE)
    (header,) = struct.unpack_from("<I", library, 0x3C)
    return {0x8664: "x86_64", 0xAA64: "aarch64"}[struct.unpack_from("<H", library, header + 4)[0]]


def test_there_is_a_binary_of_the_right_kind_for_every_platform(fmu, fmi):
    entries = read_entries(fmu)
    binaries = {name for name in entries if name.startswith("binaries/")}
    assert binaries == {f"binaries/{folder}/Ratchet{suffix}" for folder, suffix in FOLDERS[fmi].items()}
    for name in binaries:
        kind = {".so": ELF, ".dll": PE, ".dylib": UNIVERSAL if fmi == 2 else MACH_O}[name[name.rindex(".") :]]
        assert entries[name].startswith(kind), name
        if kind != UNIVERSAL:
            assert processor(entries[name]) == ("aarch64" if "aarch64" in name else "x86_64"), name


def test_the_universal_binary_holds_the_libraries_of_both_processors(native_ratchet_fmu):
    whole = read_entries(native_ratchet_fmu)["binaries/darwin64/Ratchet.dylib"]
    (count,) = struct.unpack_from(">I", whole, 4)
    parts = [struct.unpack_from(">5I", whole, 8 + 20 * k) for k in range(count)]
    inside = [whole[offset : offset + size] for _, _, offset, size, _ in parts]
    assert [processor(library) for library in inside] == ["x86_64", "aarch64"]
    assert all(library.startswith(MACH_O) for library in inside)
    assert all(offset % 2**alignment == 0 for _, _, offset, _, alignment in parts)
    assert [part[:2] for part in parts] == [struct.unpack_from("<II", library, 4) for library in inside]


def test_nothing_else_is_inside_that_does_not_belong_there(fmu, fmi):
    others = {name for name in read_entries(fmu) if not name.startswith("binaries/")}
    places = {
        2: {"model.png", "documentation/licenses/mechanism_fmu.txt"},
        3: {"terminalsAndIcons/icon.png", "documentation/licenses/license.txt"},
    }
    resources = {"resources/analysis.json", "resources/drawing.json", "resources/logic.json"}
    assert others == {"modelDescription.xml", "documentation/index.html", *resources, *places[fmi], *OF_EVERY_FLAVOUR}


def test_it_has_grown_by_no_more_than_a_twentieth(fmu, fmi):
    """Since commit 7b50d2aa, without thresholds of forces, islands of events, corners on corners, shared friction."""
    assert fmu.stat().st_size <= 1.05 * {2: 799_500, 3: 799_100}[fmi]


def test_fmpy_finds_no_problem(fmu):
    assert validate_fmu(str(fmu)) == []


def test_it_needs_no_tool_and_says_what_it_can(native_ratchet_fmu):
    slave = fmpy.read_model_description(str(native_ratchet_fmu)).coSimulation
    assert not slave.needsExecutionTool
    assert slave.canInterpolateInputs
    assert slave.maxOutputDerivativeOrder == 1
    assert not slave.canNotUseMemoryManagementFunctions
    assert slave.canGetAndSetFMUstate
    assert slave.canSerializeFMUstate
    assert slave.canHandleVariableCommunicationStepSize


def test_the_same_sources_give_the_same_bytes(fmu, fmi, tmp_path):
    assert build_native_fmu(models.load("ratchet"), tmp_path, fmi).read_bytes() == fmu.read_bytes()


def test_two_models_have_the_same_variables_in_both_flavours(native_geneva_fmu, geneva_fmu):
    native, python = (fmpy.read_model_description(str(path)) for path in (native_geneva_fmu, geneva_fmu))
    names = [(v.name, v.valueReference, v.start, v.unit) for v in native.modelVariables if v.causality != "local"]
    assert names == [(v.name, v.valueReference, v.start, v.unit) for v in python.modelVariables]
    assert native.guid != python.guid


def test_the_command_builds_it(fmu, fmi, tmp_path):
    done = CliRunner().invoke(main, ["build", "ratchet", "--flavour", "native", "--fmi", str(fmi), "-o", str(tmp_path)])
    assert done.exit_code == 0, done.output
    assert (tmp_path / "Ratchet.fmu").read_bytes() == fmu.read_bytes()
    assert "GUID" in done.output


def test_the_command_has_no_fmi3_by_pythonfmu(tmp_path):
    done = CliRunner().invoke(main, ["build", "ratchet", "--fmi", "3", "-o", str(tmp_path)])
    assert done.exit_code == 2
    assert "add --flavour native" in done.output
    assert not zipfile.is_zipfile(tmp_path / "Ratchet.fmu")


def test_without_a_linker_it_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setattr("mechanism_fmu.fmu.native.link.has_linker", lambda: False)
    done = CliRunner().invoke(main, ["build", "ratchet", "--flavour", "native", "-o", str(tmp_path)])
    assert done.exit_code == 1
    assert "python -m pip install ziglang" in done.output
    assert "Traceback" not in done.output
