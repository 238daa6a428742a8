"""The command `sweep`, on this machine, on a cluster, and killed."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

COMMAND = [sys.executable, "-c", "from harness.app.cli import main; main()", "sweep"]

CRANKS = """\
title = "Cranks"

[fmu]
file = "{fmu}"

[run]
stop_time = "10 ms"
step = 0.01

[sweep]
method = "random"
count = {count}
seed = 4

[vary.offset]
from = 0
to = {longest}
unit = "mm"

[record]
end = ["crank_angle"]
parameter = ["offset"]
"""


def file_of(folder: Path, fmu: Path, count: int, longest: int = 20) -> Path:
    path = folder / "cranks.toml"
    path.write_text(CRANKS.format(fmu=fmu, count=count, longest=longest))
    return path


def invoke(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["sweep", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, " ".join(result.output.split())


def test_a_sweep_from_the_file_to_the_report(slider_crank_fmu: Path, tmp_path: Path) -> None:
    """With offsets that some slides cannot have: these designs fail, and the others do not mind."""
    out = tmp_path / "out"
    code, text = invoke(file_of(tmp_path, slider_crank_fmu, 8, longest=2000), "-o", out, "--workers", "1")
    table = pd.read_parquet(out / "results.parquet")
    failed = table[table["status"] == "failed"]
    assert code == 1
    assert "8 designs, 8 of them run now, 0 there before" in text
    assert f"Failed designs: {len(failed)}" in text
    assert 0 < len(failed) < 8
    assert failed["message"].str.contains("crank").all()
    assert failed["end.crank_angle"].isna().all()
    assert table["end.crank_angle"].notna().sum() == 8 - len(failed)
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "<h1>Cranks</h1>" in page
    assert "offset [mm]" in page
    assert "the one with the largest end.crank_angle of all" in page
    assert "<h2>Failed designs</h2>" in page
    code, text = invoke(file_of(tmp_path, slider_crank_fmu, 8, longest=2000), "-o", out)
    assert code == 1
    assert "8 designs, 0 of them run now, 8 there before" in text


def test_a_changed_file_is_refused_with_the_way_out(slider_crank_fmu: Path, tmp_path: Path) -> None:
    assert invoke(file_of(tmp_path, slider_crank_fmu, 1), "-o", tmp_path / "out", "--workers", "1")[0] == 0
    code, text = invoke(file_of(tmp_path, slider_crank_fmu, 1, longest=21), "-o", tmp_path / "out")
    assert code == 2
    assert "[vary] differ from" in text
    assert "Choose another folder with -o" in text


def test_another_model_in_the_same_file_is_another_fmu(tmp_path: Path) -> None:
    path, text = tmp_path / "cranks.toml", CRANKS.format(fmu="", count=1, longest=20)
    path.write_text(text.replace('file = ""', 'model = "slider_crank"'))
    for _ in range(2):
        assert invoke(path, "-o", tmp_path / "out", "--fast")[0] == 0
    path.write_text(
        'fmu.model = "four_bar"\nrun = { stop_time = "10 ms", step = 0.01 }\nsweep = { method = "random", count = 1 }\n'
        'vary.crank_length = { values = [0.1] }\nrecord.end = ["crank_angle"]\n'
    )
    code, text = invoke(path, "-o", tmp_path / "out", "--fast")
    assert code == 2
    assert "holds results of another file, FMU or version: [fmu]" in text


def test_a_lock_that_cannot_be_opened_is_told(slider_crank_fmu: Path, tmp_path: Path) -> None:
    (tmp_path / "out" / ".lock").mkdir(parents=True)
    code, text = invoke(file_of(tmp_path, slider_crank_fmu, 1), "-o", tmp_path / "out")
    assert code == 2
    assert "cannot be opened" in text


def test_two_ways_at_once_are_wrong_use(slider_crank_fmu: Path, tmp_path: Path) -> None:
    path = file_of(tmp_path, slider_crank_fmu, 1)
    code, text = invoke(path, "-o", tmp_path / "out", "--fast", "--scheduler", "tcp://127.0.0.1:9")
    assert code == 2
    assert "--fast uses the threads of this machine" in text


def test_the_fast_way_runs_nobody_else_s_python_untold(slider_crank_fmu: Path, tmp_path: Path) -> None:
    """One that was changed by as little as a comment is somebody else's, whatever it says of itself."""
    foreign = tmp_path / "SliderCrank.fmu"
    shutil.copyfile(slider_crank_fmu, foreign)
    with zipfile.ZipFile(foreign, "a") as archive:
        archive.comment = b"from somebody else"
    path = file_of(tmp_path, foreign, 1)
    code, text = invoke(path, "-o", tmp_path / "out", "--fast")
    assert code == 2
    assert "--fast runs the Python sources in" in text
    assert "add --trust if you trust whoever made it" in text
    assert not (tmp_path / "out" / "results.parquet").exists()
    assert invoke(path, "-o", tmp_path / "out", "--fast", "--trust")[0] == 0
    assert invoke(file_of(tmp_path, slider_crank_fmu, 1), "-o", tmp_path / "own", "--fast")[0] == 0


def test_what_was_begun_one_way_is_finished_the_other(slider_crank_fmu: Path, tmp_path: Path) -> None:
    path, out = file_of(tmp_path, slider_crank_fmu, 8, longest=2000), tmp_path / "out"
    assert invoke(path, "-o", out, "--workers", "1")[0] == 1
    whole = pq.read_table(out / "results.parquet")
    pq.write_table(whole.slice(0, 3), out / "results.parquet")
    code, text = invoke(path, "-o", out, "--fast")
    assert (code, "8 designs, 5 of them run now, 3 there before" in text) == (1, True)
    mixed = pq.read_table(out / "results.parquet")
    assert mixed["way"].to_pylist() == ["fmu"] * 3 + ["batch"] * 5
    assert mixed.drop(["way", "message"]).equals(whole.drop(["way", "message"]))


def test_mistakes_are_wrong_use_and_nothing_is_run(slider_crank_fmu: Path, tmp_path: Path) -> None:
    path = file_of(tmp_path, slider_crank_fmu, 1)
    path.write_text(path.read_text().replace("count = 1", "count = 0").replace('"mm"', '"kg"'))
    code, text = invoke(path, "-o", tmp_path / "out")
    assert code == 2
    assert "cranks.toml has 2 mistakes; nothing was run." in text
    assert "cranks.toml:12: sweep.count: is 0, but must be a whole number, 1 or more." in text
    assert "cranks.toml:18: vary.offset.unit: unit 'kg' does not measure the same quantity" in text
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("send", "number"),
    [(os.killpg, signal.SIGINT), (os.kill, signal.SIGTERM), (os.killpg, signal.SIGTERM)],
    ids=["a terminal's Ctrl-C", "SIGTERM", "SIGTERM to all of the group"],
)
def test_ctrl_c_and_sigterm_end_cleanly(
    slider_crank_fmu: Path, tmp_path: Path, send: Callable[[int, int], None], number: signal.Signals
) -> None:
    path, out, temporary = file_of(tmp_path, slider_crank_fmu, 2000), tmp_path / "out", tmp_path / "temporary"
    temporary.mkdir()
    with subprocess.Popen(
        [*COMMAND, path, "-o", out, "--workers", "1"],
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env=os.environ | {"TMPDIR": str(temporary)},
    ) as process:
        wait_for_parts(out, 3, process)
        send(process.pid, number)
        text, _ = process.communicate()
    assert process.returncode == 130
    kept = len(pd.read_parquet(out / "parts"))
    assert 3 <= kept < 2000
    assert f"Interrupted: {kept} of 2000 designs are kept" in " ".join(text.split())
    assert [path.name for path in temporary.iterdir() if path.name.startswith("mechanism-fmu-")] == []


def wait_for_parts(out: Path, enough: int, process: "subprocess.Popen[str]") -> None:
    while len(list((out / "parts").glob("*.parquet"))) < enough and process.poll() is None:
        time.sleep(5e-3)


def test_a_scheduler_that_does_not_answer_is_wrong_use(slider_crank_fmu: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("harness.designs.cluster._PATIENCE", 0.2)
    path = file_of(tmp_path, slider_crank_fmu, 1)
    code, text = invoke(path, "-o", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert code == 2
    assert "No scheduler answers at 'tcp://127.0.0.1:9'" in text


def test_without_dask_the_extra_is_named(slider_crank_fmu: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "harness.designs.cluster", raising=False)
    path = file_of(tmp_path, slider_crank_fmu, 1)
    code, text = invoke(path, "-o", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert code == 2
    assert 'python -m pip install -e ".[cluster]"' in text


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")
def test_a_cluster_gives_what_this_machine_gives(slider_crank_fmu: Path, tmp_path: Path) -> None:
    from distributed import LocalCluster

    path = file_of(tmp_path, slider_crank_fmu, 30, longest=2000)
    address = {"host": "127.0.0.1", "dashboard_address": None}
    with LocalCluster(n_workers=2, threads_per_worker=2, **address) as cluster:
        code, text = invoke(path, "-o", tmp_path / "there", "--scheduler", cluster.scheduler_address)
    assert code == 1
    assert "30 designs, 30 of them run now" in text
    assert invoke(path, "-o", tmp_path / "here")[0] == 1
    there, here = (pd.read_parquet(tmp_path / name / "results.parquet") for name in ("there", "here"))
    pd.testing.assert_frame_equal(there, here)


@pytest.mark.slow
def test_twenty_thousand_designs_killed_ten_times(native_slider_crank_fmu: Path, tmp_path: Path) -> None:
    """With -9, at any moment: what was kept is never run again, and the table is the undisturbed one's."""
    path, out = file_of(tmp_path, native_slider_crank_fmu, 20_000), tmp_path / "killed"
    moments, kept = random.Random(7), 0
    for _ in range(10):
        before = {part: part.read_bytes() for part in (out / "parts").glob("*.parquet")}
        with subprocess.Popen([*COMMAND, path, "-o", out], stdout=subprocess.DEVNULL, text=True) as process:
            wait_for_parts(out, len(before) + 1, process)  # half a second's work each
            time.sleep(moments.uniform(0.0, 0.3))
            os.kill(process.pid, signal.SIGKILL)
        after = pd.read_parquet(out / "parts")
        assert process.returncode == -signal.SIGKILL
        assert len(after) > kept
        assert after["design"].is_unique
        assert all(part.read_bytes() == content for part, content in before.items())
        kept = len(after)
    assert kept < 20_000
    assert subprocess.run([*COMMAND, path, "-o", out], stdout=subprocess.DEVNULL, check=False).returncode == 0
    undisturbed = tmp_path / "undisturbed"
    assert subprocess.run([*COMMAND, path, "-o", undisturbed], stdout=subprocess.DEVNULL, check=False).returncode == 0
    assert (out / "results.parquet").read_bytes() == (undisturbed / "results.parquet").read_bytes()


@pytest.mark.slow
def test_the_fast_way_killed_goes_on_where_it_was(slider_crank_fmu: Path, tmp_path: Path) -> None:
    path, out, undisturbed = file_of(tmp_path, slider_crank_fmu, 20_000), tmp_path / "killed", tmp_path / "undisturbed"
    with subprocess.Popen([*COMMAND, path, "-o", out, "--fast"], stdout=subprocess.DEVNULL, text=True) as process:
        wait_for_parts(out, 12, process)
        os.kill(process.pid, signal.SIGKILL)
    kept = len(pd.read_parquet(out / "parts"))
    assert 12 <= kept < 20_000
    code, text = invoke(path, "-o", out, "--fast")
    assert (code, f"{kept} there before" in text) == (0, True)
    assert invoke(path, "-o", undisturbed, "--fast")[0] == 0
    assert (out / "results.parquet").read_bytes() == (undisturbed / "results.parquet").read_bytes()
