"""Reference results that an FMU brings along: read with care, and no number that is none passes."""

import math
from pathlib import Path

import pytest

from harness.errors import FmuError
from harness.fmu import open_fmu
from harness.fmu.description_file import read_description
from harness.run.validate import ReferenceResults, farthest, read_reference, validate
from mechanism_fmu.fmu.disk.archive import read_entries, write_archive

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"


def results(*column: float) -> ReferenceResults:
    return ReferenceResults("a.csv", ("y",), tuple(map(float, range(len(column)))), tuple((v,) for v in column), {})


def test_the_farthest_is_found_relative_to_the_largest_value():
    assert farthest(results(1.0, -4.0, 2.0), [[1.0], [-4.0], [2.5]]) == (0.125, "y", 2.0)
    assert farthest(results(0.0, 0.0), [[0.0], [0.25]]) == (0.25, "y", 1.0)


@pytest.mark.parametrize("found", [[1.0, 500.0, math.nan, 1.0], [math.nan, 1.0, 1.0, 1.0], [1.0, 1.0, 1.0, math.nan]])
def test_nan_is_never_near(found):
    assert farthest(results(1.0, 1.0, 1.0, 1.0), [[value] for value in found])[0] == math.inf


def changed(ratchet_fmu: Path, folder: Path, name: str, change) -> Path:
    """A copy of the FMU in which one file of its reference results is another one."""
    entries = read_entries(ratchet_fmu)
    entries[f"{FOLDER}/{name}"] = change(entries[f"{FOLDER}/{name}"])
    path = folder / "Ratchet.fmu"
    write_archive(entries, path)
    return path


def verdict(path: Path):
    with open_fmu(path) as fmu:
        *_, last = validate(fmu)
    return last


def test_a_changed_number_is_seen(native_ratchet_fmu, tmp_path):
    path = changed(
        native_ratchet_fmu, tmp_path, "Ratchet_ref.csv", lambda data: data.replace(b"1.308996939,", b"1.308997939,", 1)
    )
    last = verdict(path)
    assert not last.passed
    assert "wheel_angle at t = 0 s is off by" in last.evidence


def test_its_parameters_are_set(native_ratchet_fmu, tmp_path):
    path = changed(
        native_ratchet_fmu,
        tmp_path,
        "Ratchet_default.ssv",
        lambda data: data.replace(b'name="tooth_count">', b'name="tooth_count"><!-- -->').replace(
            b'Integer value="10"', b'Integer value="11"'
        ),
    )
    last = verdict(path)
    assert not last.passed
    assert "is off by" in last.evidence


@pytest.mark.parametrize(
    ("name", "contents", "said"),
    [
        ("fmi-ls-manifest.xml", b'<?xml version="1.0" encoding="foo"?><a/>', "is no XML"),
        ("fmi-ls-manifest.xml", b"<a", "is no XML"),
        (
            "fmi-ls-manifest.xml",
            b'<fmiReferences><Related role="result" type="text/csv" source="../x.csv"/></fmiReferences>',
            "which is no file beside it",
        ),
        ("Ratchet_ref.csv", b"time,wheel_angle\n0,x\n", "cannot be read"),
        ("Ratchet_ref.csv", b"time,nothing\n0,1\n", "no column time"),
        ("Ratchet_ref.csv", b"time,wheel_angle\n1,1\n0,1\n", "do not increase"),
        ("Ratchet_default.ssv", b"<a", "cannot be read"),
    ],
)
def test_what_cannot_be_read_is_said(native_ratchet_fmu, tmp_path, name, contents, said):
    path = changed(native_ratchet_fmu, tmp_path, name, lambda _: contents)
    with open_fmu(path) as fmu, pytest.raises(FmuError, match=said):
        read_reference(fmu.folder, fmu.description)


def test_rows_of_one_time_and_truth_values(native_ratchet_fmu, tmp_path):
    text = b"time,wheel_angle,impact\n0,1,false\n1,2,false\n1,3,true\n"
    path = changed(native_ratchet_fmu, tmp_path, "Ratchet_ref.csv", lambda _: text)
    with open_fmu(path) as fmu:
        found = read_reference(fmu.folder, read_description(path))
    assert found is not None
    assert found.times == (0.0, 1.0)
    assert found.rows == ((1.0, 0.0), (3.0, 1.0))
    assert found.parameters["tooth_count"] == 10
