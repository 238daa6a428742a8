"""A sweep as a whole: designs, results on the disk, and what happens when it is killed."""

import multiprocessing
import os
import signal
import time
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from cheap_designs import (
    DEADLY,
    FAILING,
    LONG,
    ONE_TAKES_LONG,
    SQUARE,
    TROUBLED,
    axis,
    begin_processes_with_what_they_need,
    cheap_sweep,
    run_cheap,
    run_until_killed,
    store_of,
    work_of,
)
from fake_slave import fake_description
from hypothesis import given, strategies as st
from scipy.stats import qmc

from harness.designs import store as identities, store as stores, sweep
from harness.designs.store import Store, code_of, contents, failures, identity
from harness.designs.sweep import Progress, perform_sweep, range_cells
from harness.designs.task import Design, Quantity, Result, Task, When
from harness.designs.workers import Backend, Processes, Work, here
from harness.errors import UsageError
from harness.run.master import TimeGrid


@pytest.fixture(scope="module", autouse=True)
def _processes_begin_with_what_they_need() -> None:
    begin_processes_with_what_they_need()


@given(st.sampled_from(sorted(sweep.METHODS)), st.integers(1, 40), st.integers(0, 10))
def test_a_list_of_designs_is_the_same_each_time_and_within_its_limits(method: str, count: int, seed: int) -> None:
    axes = [axis(), axis("tooth_count", 10, 25), axis("tooth_slope_angle", 85, 105, "deg")]
    designs = sweep.sampled(axes, method, count, seed)
    assert designs == sweep.sampled(axes, method, count, seed)
    assert [design.number for design in designs] == list(range(1, count + 1))
    for design in designs:
        assert 0.0 <= design.values["restitution"] < 1.0
        assert design.values["tooth_count"] in range(10, 26)
        assert np.radians(85) <= design.values["tooth_slope_angle"] <= np.radians(105)


def test_a_latin_hypercube_has_one_design_in_each_row_and_column() -> None:
    designs = sweep.sampled([axis(), axis("tooth_count", 10, 25)], "latin_hypercube", 16, 5)
    assert sorted(int(16 * design.values["restitution"]) for design in designs) == list(range(16))
    assert sorted(design.values["tooth_count"] for design in designs) == list(range(10, 26))


def test_sobol_points_are_more_even_than_random_ones() -> None:
    def unevenness(method: str) -> float:
        return qmc.discrepancy(sweep.METHODS[method](256, 2, 1))

    assert unevenness("sobol") < 0.1 * unevenness("random")


def test_whole_numbers_are_all_equally_likely() -> None:
    designs = sweep.sampled([axis("tooth_count", 10, 25)], "sobol", 1024, 3)
    counts = np.bincount([int(design.values["tooth_count"]) for design in designs])
    assert list(counts[10:]) == [64] * 16


def test_results_are_a_table_with_units_that_pandas_opens(tmp_path: Path) -> None:
    run_cheap(20, tmp_path)
    table = pd.read_parquet(tmp_path / "results.parquet")
    assert list(table.columns) == ["design", "restitution", "end.square", "way", "status", "message", "warnings"]
    assert list(table["design"]) == list(range(1, 21))
    np.testing.assert_array_equal(table["end.square"], table["restitution"] ** 2)
    assert set(table["way"]) == {"cheap"}
    assert set(table["status"]) == {"ok"}
    assert pq.read_schema(tmp_path / "results.parquet").field("end.square").metadata == {b"unit": b"m2"}
    assert not (tmp_path / "parts").exists()


def test_a_complete_sweep_runs_nothing_again(tmp_path: Path) -> None:
    run_cheap(20, tmp_path)
    before = (tmp_path / "results.parquet").read_bytes()
    run_cheap(20, tmp_path)
    assert (tmp_path / "results.parquet").read_bytes() == before
    assert len((tmp_path / "trace").read_text().split()) == 20


def test_a_sweep_that_was_asked_to_stop_goes_on_later(tmp_path: Path) -> None:
    sweep = cheap_sweep(20)
    store, asked = store_of(sweep, tmp_path), iter([False] * 5 + [True])
    progress, table = perform_sweep(sweep, store, partial(here, work_of(sweep, tmp_path)), print, lambda: next(asked))
    assert progress == Progress(total=20, earlier=0, done=5, failed=0)
    assert table["design"].to_pylist() == [1, 2, 3, 4, 5]
    assert len(pd.read_parquet(tmp_path / "parts")) == 5  # what there is can be looked at
    run_cheap(20, tmp_path)
    assert sorted(map(int, (tmp_path / "trace").read_text().split())) == list(range(1, 21))


@pytest.mark.parametrize(("count", "seed", "method"), [(21, 1, "sobol"), (20, 2, "sobol"), (20, 1, "random")])
def test_a_folder_of_other_designs_is_refused(count: int, seed: int, method: str, tmp_path: Path) -> None:
    store_of(cheap_sweep(20), tmp_path)
    with pytest.raises(UsageError, match=r"holds results of another file, FMU or version: \[sweep\] differ .* -o"):
        store_of(cheap_sweep(count, method, seed), tmp_path)


def test_a_folder_whose_owner_nobody_knows_is_refused(tmp_path: Path) -> None:
    run_cheap(3, tmp_path)
    (tmp_path / "identity.json").write_text("{")
    with pytest.raises(UsageError, match="cannot be read"):
        store_of(cheap_sweep(3), tmp_path)
    (tmp_path / "identity.json").unlink()
    with pytest.raises(UsageError, match=r"has results, but no identity\.json"):
        store_of(cheap_sweep(3), tmp_path)


def test_a_folder_that_was_claimed_and_no_more_is_taken_up(tmp_path: Path) -> None:
    store_of(cheap_sweep(3), tmp_path)
    (tmp_path / "parts").rmdir()
    run_cheap(3, tmp_path)
    assert len(pd.read_parquet(tmp_path / "results.parquet")) == 3


def test_a_broken_part_is_told_with_the_way_out(tmp_path: Path) -> None:
    store = store_of(cheap_sweep(3), tmp_path)
    (tmp_path / "parts" / "000000001.parquet").write_bytes(b"PAR1")
    with pytest.raises(UsageError, match="Remove this file, and the same command runs its designs again"):
        store.results()


def test_killed_between_the_table_and_the_removal_of_parts_nothing_is_twice(tmp_path: Path) -> None:
    sweep = cheap_sweep(3)
    store = store_of(sweep, tmp_path)
    pairs = [(design, Result(design.number, "cheap", (1.0,))) for design in sweep.designs]
    store.append(pairs)
    store.finish()
    store = store_of(sweep, tmp_path)
    store.append(pairs[1:])
    assert store.finish()["design"].to_pylist() == [1, 2, 3]


class Killed(BaseException):
    """Nothing that the code under test could catch as an error."""


def test_many_parts_become_one_and_a_kill_at_any_moment_of_it_loses_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stores, "_MOST_LOOSE", 5)
    sweep = cheap_sweep(5)
    pairs = [(design, Result(design.number, "cheap", (design.number / 3,))) for design in sweep.designs]
    rename, unlink, calls = os.replace, Path.unlink, 0
    left: list[int] = []

    def keep(store: Store) -> None:
        for pair in pairs:
            store.append([pair])

    def deadly(call: Any, of: int) -> Any:
        def called(*arguments: Any, **options: Any) -> Any:
            nonlocal calls
            if calls == of:
                raise Killed
            calls += 1
            return call(*arguments, **options)

        return called

    for moment in range(10):  # five parts are renamed, then the one of all, then four are removed
        folder, calls = tmp_path / f"{moment}", 0
        store = store_of(sweep, folder)
        with monkeypatch.context() as patch:
            patch.setattr(os, "replace", deadly(rename, moment))
            patch.setattr(Path, "unlink", deadly(unlink, moment))
            with pytest.raises(Killed):
                keep(store)
        left.append(parts(folder))
        there = store_of(sweep, folder).pairs()
        assert there == {d.number: (d.values, result) for d, result in pairs[:moment]}
    assert left == [0, 1, 2, 3, 4, 5, 5, 4, 3, 2]
    store = store_of(sweep, tmp_path / "whole")
    keep(store)
    assert parts(tmp_path / "whole") == 1
    assert len(store.pairs()) == 5


def test_what_fails_and_what_kills_its_process_is_recorded_and_the_rest_goes_on(tmp_path: Path) -> None:
    sweep = cheap_sweep(20)
    with Processes(work_of(sweep, tmp_path, TROUBLED), 2) as processes:
        progress, table = perform_sweep(sweep, store_of(sweep, tmp_path), processes.run, lambda progress: None)
    assert progress == Progress(total=20, earlier=0, done=20, failed=2)
    (failing, why), (deadly, how) = failures(table)
    assert (failing, why) == (FAILING, "the pawl has left the wheel.")
    assert deadly == DEADLY
    assert "ended without a word" in how
    values = table["end.square"].to_pylist()
    assert [number for number, value in enumerate(values, start=1) if value is None] == [FAILING, DEADLY]


def test_results_are_kept_together_but_wait_for_no_design_that_takes_long(tmp_path: Path) -> None:
    """The last but one of 41 designs takes two seconds: meanwhile the others come, in portions of half a second."""
    sweep = cheap_sweep(41)
    came = []
    with Processes(work_of(sweep, tmp_path, ONE_TAKES_LONG), 2) as processes:
        for pairs in processes.run(sweep.designs):
            came.append({design.number for design, _ in pairs})
    assert sorted(number for numbers in came for number in numbers) == list(range(1, 42))
    assert len(came) <= 6
    assert LONG in came[-1]
    assert len(came[-1]) <= 2  # itself, and what waited behind it


def parts(folder: Path) -> int:
    """How many designs are kept: in this process, each in a part of its own."""
    return len(list((folder / "parts").glob("*.parquet")))


def test_a_sweep_killed_at_any_moment_gives_what_an_undisturbed_one_gives(tmp_path: Path) -> None:
    """The slow test of the command does the same with 20,000 designs of a real FMU."""
    killed, trace = tmp_path / "killed", tmp_path / "killed" / "trace"
    count, kills = 150, 4
    for kill in range(1, kills + 1):
        process = multiprocessing.get_context("forkserver").Process(target=run_until_killed, args=(count, killed))
        process.start()
        while parts(killed) < kill * count // (kills + 2):
            assert process.is_alive()
            time.sleep(2e-3)
        assert process.pid is not None
        os.kill(process.pid, signal.SIGKILL)
        process.join()
        assert process.exitcode == -signal.SIGKILL
        ran = trace.read_text().split()
        assert parts(killed) <= len(ran) <= parts(killed) + kill  # a design for each kill was on its way
    run_cheap(count, killed)
    run_cheap(count, tmp_path / "undisturbed")
    results = [tmp_path / name / "results.parquet" for name in ("killed", "undisturbed")]
    assert results[0].read_bytes() == results[1].read_bytes()
    assert count <= len(trace.read_text().split()) <= count + kills


def test_ranges_leave_out_what_is_no_value_and_name_the_first_of_equals() -> None:
    assert range_cells(np.array([np.nan, 2.0, 1.0, 1.0, np.inf]), [1, 2, 3, 4, 5]) == ["1", "3", "inf", "5"]
    assert range_cells(np.array([np.nan]), [1]) == ["", "", "", ""]


def test_portions_are_as_large_as_fits_in_a_moment(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many designs that fail at once, then slow ones, then quick ones."""
    now, seconds = [0.0], {True: 1e-6, False: 0.1}
    monkeypatch.setattr("harness.designs.workers.perf_counter", lambda: now[0])
    sizes: list[int] = []

    def run(fmu: object, task: Task, designs: Sequence[Design]) -> list[Result]:
        sizes.append(len(designs))
        failing = designs[-1].number <= 50
        now[0] += len(designs) * seconds[failing or designs[-1].number > 100]
        return [
            Result.failed(design, "cheap", task, "no") if failing else Result(design.number, "cheap", (1.0,))
            for design in designs
        ]

    sweep = cheap_sweep(1000)
    work = Work(None, sweep.task, Backend("cheap", run, 256))  # type: ignore[arg-type]
    assert sum(len(pairs) for pairs in here(work, sweep.designs)) == 1000
    assert set(sizes[:50]) == {1}
    assert sizes[50:60] == [1, 2, 4, 5, 5, 5, 5, 5, 5, 5]
    assert max(sizes) == 256


@dataclass(frozen=True)
class File:
    """What `contents` needs of an FMU."""

    path: Path
    description = fake_description()


def test_stresses_of_other_code_are_not_mixed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = (tmp_path / name / "stress" for name in ("one", "other"))
    for folder in (one, other):
        (folder / "beams").mkdir(parents=True)
        (folder / "beams" / "wedge.py").write_text("ROOT = 2.5")
    assert code_of([one]) == code_of([other])
    (other / "beams" / "wedge.py").write_text("ROOT = 2.6")
    stress = Quantity(When.FIRST_IMPACT, "stress_max", "Real", "Pa")
    task = Task(TimeGrid.of(1.0, 0.1), {}, None, (stress,))
    found = []
    for folder in (one, other):
        monkeypatch.setattr(identities, "_STRESS_CODE", (folder,))
        found.append(identity({}, task, (), ("sweep", {})))
    assert found[0].changed(found[1].topics) == ["mechanism_fmu"]
    without = identity({}, replace(task, quantities=(SQUARE,)), (), ("sweep", {}))
    assert without.topics["mechanism_fmu"]["stress"] is None


def test_an_edited_fmu_is_another_one_and_one_made_again_is_not(tmp_path: Path) -> None:
    """Nobody who edits a start value thinks of the GUID."""
    texts = {
        name: f'<fmiModelDescription guid="x" generationDateAndTime="{date}" start="{start}"/>'
        for name, date, start in [("first", 2025, 1), ("again", 2026, 1), ("edited", 2025, 2)]
    }
    found = {}
    for name, text in texts.items():
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            archive.writestr("modelDescription.xml", text)
        found[name] = contents(File(tmp_path / name))  # type: ignore[arg-type]
    assert found["first"] == found["again"]
    assert found["first"]["sha256"] != found["edited"]["sha256"]
    assert found["first"]["guid"] == found["edited"]["guid"] == fake_description().guid
