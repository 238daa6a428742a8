"""Tables of input signals: whatever the bytes, read or refused; whatever the locale, the numbers are the same."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from harness.run.inputs import InputSignals, read_inputs
from tests.fuzz.input_bytes import CORPUS, NASTY, damaged, fuzzed, nasty, read_or_refused
from tests.harness.fake_slave import fake_description

SOUND = b"time [ms],drive_torque [N.mm],gear\n0,2.5,1\n1000,-3.5e1,2\n2000,4,3\n"
SEEDS = sorted(CORPUS.glob("csv/*"))


def read(path: Path) -> InputSignals | None:
    signals = read_or_refused(lambda: read_inputs(path, fake_description(), 0.0, 2.0), path)
    if signals is not None:
        assert np.all(np.isfinite(signals.values))
        assert np.all(np.diff(signals.times) > 0.0)
        assert signals.values.shape == (len(signals.times), len(signals.variables))
        assert all(map(math.isfinite, map(float, signals.at(1.0).values())))
    return signals


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("csv") / "signals.csv"


def test_the_corpus_is_there() -> None:
    assert len(SEEDS) >= 8


@pytest.mark.parametrize("seed", SEEDS, ids=lambda seed: seed.name)
def test_the_corpus_is_read_or_refused(seed: Path) -> None:
    signals = read(seed)
    assert (signals is not None) == seed.name.startswith("read")


def test_what_is_damaged_was_sound(path: Path) -> None:
    path.write_bytes(SOUND)
    assert read(path) is not None


@fuzzed
@given(data=damaged(SOUND) | damaged(SOUND.replace(b",", b";")) | st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(path: Path, data: bytes) -> None:
    path.write_bytes(data)
    read(path)


CELL = nasty | st.floats().map(repr) | st.text(max_size=8)


@fuzzed
@given(
    cells=st.lists(st.lists(CELL, min_size=2, max_size=3), max_size=5),
    header=st.sampled_from(["time,drive_torque", "time [ms];gear [1]", '"time","gear"', "time;drive_torque;brake"]),
    delimiter=st.sampled_from([",", ";", "\t"]),
)
def test_any_cells_are_read_or_refused(path: Path, cells: list[list[str]], header: str, delimiter: str) -> None:
    path.write_text("\n".join([header, *(delimiter.join(row) for row in cells)]), encoding="utf-8")
    read(path)


NUMBER = st.floats(-1e12, 1e12).map(lambda x: float(f"{x:.6g}"))


@fuzzed
@given(
    values=st.lists(NUMBER, min_size=2, max_size=6),
    form=st.sampled_from(["{:.6g}", "{:.7e}", "{:+.9f}", "{:r}"]),
    end=st.sampled_from(["\n", "\r\n"]),
)
def test_a_table_means_the_same_in_every_locale(path: Path, values: list[float], form: str, end: str) -> None:
    """Commas and points, semicolons and points, semicolons and decimal commas: the same doubles."""
    times = np.linspace(0.0, 2.0, len(values))
    written = [
        [repr(float(t)), repr(v) if form == "{:r}" else form.format(v)] for t, v in zip(times, values, strict=True)
    ]
    found = []
    for delimiter, point in ((",", "."), (";", "."), (";", ",")):
        rows = [delimiter.join(cell.replace(".", point) for cell in row) for row in written]
        path.write_text(end.join([f"time{delimiter}drive_torque", *rows]) + end, encoding="utf-8")
        found.append(read_inputs(path, fake_description(), 0.0, 2.0))
    for signals in found:
        assert signals.times.tolist() == [float(t) for t, _ in written]
        assert signals.values[:, 0].tolist() == [float(v) for _, v in written]
    assert [bool(signals.note) for signals in found] == [False, True, True]


@pytest.mark.parametrize("text", NASTY)
def test_one_bad_cell_is_named_with_its_line(path: Path, text: str) -> None:
    path.write_text(f'time,drive_torque\n0,1\n1,"{text}"\n2,1\n', encoding="utf-8")
    signals = read_or_refused(lambda: read_inputs(path, fake_description(), 0.0, 2.0), path, "signals.csv, line 3")
    if signals is not None:
        assert signals.values[1, 0] == float(text)
