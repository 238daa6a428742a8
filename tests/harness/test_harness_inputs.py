from pathlib import Path

import numpy as np
import pytest
from fake_slave import fake_description
from hypothesis import given, strategies as st

from harness.errors import UsageError
from harness.run.inputs import InputSignals, check_no_overlap, read_inputs


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


@pytest.mark.parametrize(
    "text",
    [
        "time [ms];drive_torque [N.mm]\n0;2,5\n1000,0;-3,5e1\n2000;4\n",
        "time [ms] ; drive_torque [N.mm]\n0 ; +2,5\n1000, ; -35\n2000;4,\n",
        '"time [ms]";"drive_torque [N.mm]"\r\n"0";"2,5"\r\n1000;-35,000\r\n2000;4,00\r\n',
        "\ufefftime [ms];drive_torque [N.mm]\n,0;2,5\n1000;-35\n2000;4\n",
    ],
)
def test_semicolons_and_decimal_commas_are_recognised_and_said(tmp_path: Path, text: str) -> None:
    signals = table(tmp_path, text)
    assert signals.times == pytest.approx([0.0, 1.0, 2.0])
    assert signals.values[:, 0] == pytest.approx([2.5e-3, -35e-3, 4e-3])
    assert signals.note == "signals.csv: columns are joined by semicolons, numbers have decimal commas."


def test_semicolons_with_decimal_points_are_recognised_and_said(tmp_path: Path) -> None:
    signals = table(tmp_path, "time;drive_torque\n0;1.5\n2;2.5\n")
    assert signals.values[:, 0].tolist() == [1.5, 2.5]
    assert signals.note == "signals.csv: columns are joined by semicolons."


def test_nothing_is_said_of_a_usual_table(tmp_path: Path) -> None:
    assert table(tmp_path, "time,drive_torque\n0,1.5\n2,2.5\n").note == ""


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "time;drive_torque\n0;1,5\n2;2.5\n",
            "'1,5' in line 2 has a comma and '2.5' in line 3 a point, so it is not clear .* write all numbers alike",
        ),
        ("time;drive_torque\n0;1,500\n2;2,250\n", "line 2: '1,500' may be a number with three decimals or .* thousand"),
        ("time;drive_torque\n0;1.234,5\n2;1\n", r"line 2: '1\.234,5' is not a finite number"),
        ("time;drive_torque\n0;1,234,567\n2;1\n", "line 2: '1,234,567' is not a finite number"),
        ("time,drive_torque\n0,0,1,5\n2,0,2,5\n", "line 2: has 4 values, .* 2 headings. If its numbers have decimal"),
        ("time,drive_torque\n0;1\n2;1\n", "line 2: has 1 values, .* join the headings by semicolons, too"),
        ("time,drive_torque\n0;1,5\n2;2,5\n", "line 2: '0;1' is not a finite number|joined by semicolons"),
        ("time;drive_torque\n0,1\n2,1\n", "line 2: has 1 values, .* join the headings by commas, too"),
        ("time;drive_torque;\n0;1\n2;1\n", "has 2 values, but there are 3 headings"),
        ("time,drive_torque\n0,1_0\n2,1\n", "'1_0' is not a finite number"),
        ("time,drive_torque\n0,١\n2,1\n", "'١' is not a finite number"),
        ("time,drive_torque\n0,1e400\n2,1\n", "'1e400' is not a finite number"),
    ],
)
def test_tables_that_may_mean_this_or_that_are_refused(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        table(tmp_path, text)


def test_three_decimals_are_decimals_where_one_number_shows_it(tmp_path: Path) -> None:
    assert table(tmp_path, "time;drive_torque\n0;0,125\n2;1,250\n").values[:, 0].tolist() == [0.125, 1.25]


def test_thousands_are_no_quarrel_in_a_table_with_commas(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="is not a finite number"):
        table(tmp_path, 'time,drive_torque\n0,"1,5"\n2,"1,234"\n')
