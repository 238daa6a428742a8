from pathlib import Path

import numpy as np
import pytest
from fake_slave import fake_description
from hypothesis import given
from hypothesis import strategies as st

from harness.errors import UsageError
from harness.inputs import InputSignals, check_no_overlap, read_inputs


def table(folder: Path, text: str) -> InputSignals:
    path = folder / "signals.csv"
    path.write_text(text, encoding="utf-8")
    return read_inputs(path, fake_description(), 0.0, 2.0)


def test_real_inputs_are_interpolated_and_others_held(tmp_path: Path) -> None:
    signals = table(tmp_path, "time,drive_torque,gear,brake\n0,0,1,0\n1,10,3,1\n2,20,5,0\n")
    assert signals.at(0.5) == {"drive_torque": 5.0, "gear": 1, "brake": False}
    assert signals.at(1.0) == {"drive_torque": 10.0, "gear": 3, "brake": True}
    assert signals.at(2.0) == {"drive_torque": 20.0, "gear": 5, "brake": False}
    assert type(signals.at(1.5)["gear"]) is int
    assert type(signals.at(1.5)["brake"]) is bool


def test_units_in_the_headings(tmp_path: Path) -> None:
    signals = table(tmp_path, "time [ms], drive_torque [N.mm]\n0, 2\n2000, 4\n")
    assert signals.times == pytest.approx([0.0, 2.0])
    assert signals.at(1.0)["drive_torque"] == pytest.approx(3e-3)


def test_a_file_saved_by_a_spreadsheet_is_read(tmp_path: Path) -> None:
    signals = table(tmp_path, "\ufefftime,drive_torque\r\n0,1\r\n\r\n2,1\r\n")
    assert signals.at(1.0) == {"drive_torque": 1.0}


@given(st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=10), st.floats(0.0, 2.0))
def test_interpolation_stays_between_its_neighbours(values: list[float], time: float) -> None:
    times = np.linspace(0.0, 2.0, len(values))
    signals = InputSignals((fake_description().variables["drive_torque"],), times, np.array(values)[:, None])
    assert signals.at(time)["drive_torque"] == pytest.approx(np.interp(time, times, values), abs=1e-9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "needs a line of headings"),
        ("time,drive_torque\n", "at least one row"),
        ("drive_torque,time\n1,0\n1,2\n", "first column is 'drive_torque', but it must be 'time'"),
        ("time;drive_torque\n0;1\n2;1\n", "must be 'time'"),
        ("time\n0\n2\n", "time column only"),
        ("time,drive_torque,drive_torque\n0,1,1\n2,1,1\n", "'drive_torque' is there twice"),
        ("time,torque\n0,1\n2,1\n", "no variable 'torque'"),
        ("time,wheel_angle\n0,1\n2,1\n", "causality output and cannot be set"),
        ("time,tooth_count\n0,10\n2,10\n", "is a parameter, which cannot change during a run; set its value"),
        ("time,drive_torque [\n0,1\n2,1\n", "is no heading"),
        ("time,drive_torque [mm]\n0,1\n2,1\n", "column 'drive_torque': unit 'mm' does not measure"),
        ("time [m],drive_torque\n0,1\n2,1\n", "column 'time': unit 'm' does not measure"),
        ("time,gear [m]\n0,1\n2,1\n", r"'gear' has no unit; leave out \[m\]"),
        ("time,gear\n0,1.5\n2,1\n", "'gear' is Integer; give whole numbers"),
        ("time,drive_torque\n0,1\n1\n2,1\n", "line 3: has 1 values, but there are 2 headings"),
        ("time,drive_torque\n0,1\n1,\n2,1\n", "line 3: '' is not a finite number"),
        ("time,drive_torque\n0,1\n1,nan\n2,1\n", "line 3: 'nan' is not a finite number"),
        ("time,drive_torque\n0,1\n1,two\n2,1\n", "line 3: 'two' is not a finite number"),
        ("time,drive_torque\n0,1\n1,1\n1,2\n2,1\n", "time must increase from row to row, but 1 s follows 1 s"),
        ("time,drive_torque\n0,1\n1.5,1\n", "covers 0 s to 1.5 s, but the run goes from 0 s to 2 s"),
        ("time,drive_torque\n0.5,1\n2,1\n", "covers 0.5 s to 2 s"),
    ],
)
def test_tables_that_cannot_be_used_are_refused(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        table(tmp_path, text)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot be read"):
        read_inputs(tmp_path / "nowhere.csv", fake_description(), 0.0, 1.0)


def test_a_binary_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "signals.csv"
    path.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(UsageError, match="cannot be read"):
        read_inputs(path, fake_description(), 0.0, 1.0)


def test_an_input_may_not_be_set_and_driven(tmp_path: Path) -> None:
    signals = table(tmp_path, "time,drive_torque\n0,1\n2,1\n")
    with pytest.raises(UsageError, match="in the input table and in --set"):
        check_no_overlap(signals, {"drive_torque": 1.0})
