"""The command `optimise`."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

CRANKS = """\
title = "The shortest crank"

[fmu]
file = "{fmu}"

[run]
stop_time = "10 ms"
step = 0.01

[optimise]
minimise = "parameter.crank_length"
count = 40
{method}

[vary.crank_length]
from = 40
to = 60
unit = "mm"

[vary.offset]
from = 0
to = 20
unit = "mm"

[constraint."parameter.offset"]
at_least = {least}
unit = "mm"
"""


def file_of(folder: Path, fmu: Path, least: int = 10, method: str = "") -> Path:
    path = folder / "cranks.toml"
    path.write_text(CRANKS.format(fmu=fmu, least=least, method=method))
    return path


def invoke(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["optimise", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, " ".join(result.output.split())


def test_an_optimum_from_the_file_to_the_report(slider_crank_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    code, text = invoke(file_of(tmp_path, slider_crank_fmu), "-o", out, "--workers", "1")
    assert code == 0
    assert (
        "The shortest crank: the smallest parameter.crank_length in up to 40 designs (differential_evolution)" in text
    )
    assert "40 designs, 0 of them there before." in text
    best = json.loads((out / "optimum.json").read_text())
    assert best["keeps_constraints"]
    assert best["values"]["crank_length"] == pytest.approx(0.040, rel=0.02)
    assert best["values"]["offset"] >= 0.010
    table = pd.read_parquet(out / "results.parquet")
    kept = table[table["parameter.offset"] >= 0.010]
    assert kept["parameter.crank_length"].min() == best["values"]["crank_length"]
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "<h1>The shortest crank</h1>" in page
    assert "<h2>Search</h2>" in page
    assert f"<h2>Mechanism</h2></summary><p>Design {best['design']}, the best: " in page
    before = (out / "results.parquet").read_bytes()
    assert "40 designs, 40 of them there before." in invoke(file_of(tmp_path, slider_crank_fmu), "-o", out)[1]
    assert (out / "results.parquet").read_bytes() == before


def test_a_goal_out_of_reach_is_told(slider_crank_fmu: Path, tmp_path: Path) -> None:
    code, text = invoke(file_of(tmp_path, slider_crank_fmu, least=21), "-o", tmp_path / "out", "--workers", "1")
    assert code == 1
    assert "No design keeps all constraints; the one shown misses them least." in text


def test_without_optuna_the_extra_is_named(slider_crank_fmu: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "optuna", None)
    path = file_of(tmp_path, slider_crank_fmu, method='method = "tpe"')
    code, text = invoke(path, "-o", tmp_path / "out", "--workers", "1")
    assert code == 2
    assert 'python -m pip install -e ".[optimise]"' in text


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGTERM there")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_and_sigterm_keep_the_designs_there_are(
    slider_crank_fmu: Path, tmp_path: Path, number: signal.Signals
) -> None:
    path, out, temporary = file_of(tmp_path, slider_crank_fmu), tmp_path / "out", tmp_path / "temporary"
    path.write_text(path.read_text().replace("count = 40", "count = 4000"))
    temporary.mkdir()
    with subprocess.Popen(
        [
            sys.executable,
            "-c",
            "from harness.app.cli import main; main()",
            "optimise",
            path,
            "-o",
            out,
            "--workers",
            "1",
        ],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(temporary)},
    ) as process:
        while len(list((out / "parts").glob("*.parquet"))) < 3 and process.poll() is None:
            time.sleep(5e-3)
        process.send_signal(number)
        said, _ = process.communicate(timeout=120)
    assert process.returncode == 130
    kept = pd.read_parquet(out / "parts")
    assert 3 <= len(kept) < 4000
    text = " ".join(said.split())
    assert f"Interrupted: {len(kept)} designs are kept in {out}." in text
    assert "The same command goes on." in text
    assert list(temporary.iterdir()) == []
    assert not list(out.rglob(".*.unfinished"))
