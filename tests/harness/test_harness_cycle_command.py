"""`mechanism-fmu cycle`: what it gives as data and writes, and what it refuses."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

WOODPECKER = str(Path(__file__).parents[2] / "docs" / "examples" / "gallery" / "woodpecker.py")
ASKED = ["cycle", WOODPECKER, "--unknown", "start=bird", "--section", "bird_rate"]


def test_the_woodpecker_as_data_and_as_files(tmp_path: Path) -> None:
    done = CliRunner().invoke(main, [*ASKED, "--json", "-o", str(tmp_path / "cycle.csv")])
    assert done.exit_code == 0
    data = json.loads(done.stdout)
    assert data["period"] == pytest.approx(0.13074752, abs=5e-9)
    assert data["stable"] is True
    assert data["multipliers"][0]["real"] == pytest.approx(-0.0492, abs=5e-5)
    assert [event["event"] for event in data["events"]][2] == "beak.gap"
    assert data["events"][2]["closing_speed"] == pytest.approx(0.2956, abs=1e-4)
    assert data["residual"] < 1e-10
    assert data["files"] == [str(tmp_path / "cycle.csv")]

    table = pd.read_csv(tmp_path / "cycle.csv")
    assert table.kind.unique().tolist() == ["period", "start", "multiplier", "moved", "event", "stable", "residual"]
    by_name = table.set_index(["kind", "name"]).value
    assert by_name["multiplier", "real[1]"] == pytest.approx(data["multipliers"][0]["real"], abs=1e-15)
    assert by_name["start", "start"] == pytest.approx(data["start"]["start"], abs=1e-15)


def test_json_has_all(tmp_path: Path) -> None:
    path = tmp_path / "cycle.json"
    done = CliRunner().invoke(main, [*ASKED, "-o", str(path)])
    assert done.exit_code == 0
    assert "Stable: of a small disturbance 4.92 % is left after one cycle" in done.stdout
    data = json.loads(path.read_text(encoding="utf-8"))
    assert np.linalg.eigvals(np.array(data["matrix"]))[0] == pytest.approx(data["multipliers"][0]["real"])


@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        (["--unknown", "start=bird"], 2, "Say where a cycle ends"),
        ([*ASKED[2:], "--period", "1s"], 2, "one of the two"),
        (["--unknown", "start=bird", "--period", "-1s"], 2, "--period is -1 s, but must be positive and finite"),
        (["--unknown", "start=bird", "--period", "1m"], 2, "--period wants s"),
        (["--unknown", "start=bird", "--section", "beak_rate"], 2, "There is no output 'beak_rate' for a section"),
        (["--section", "bird_rate"], 2, "say what is unknown"),
        ([*ASKED[2:], "-o", "cycle.txt"], 2, "give a file that ends in .csv or .json"),
        ([*ASKED[2:], "-o", "nowhere/cycle.csv"], 2, "There is no folder"),
        ([*ASKED[2:], "--longest", "0.05s"], 1, "bird_rate passes 0 rising 0 times within 0.05 s"),
    ],
)
def test_what_is_refused(options: list[str], code: int, said: str) -> None:
    done = CliRunner().invoke(main, ["cycle", WOODPECKER, *options])
    assert done.exit_code == code, done.output
    assert said in " ".join(done.output.split())


def test_a_model_that_is_not_there_is_refused() -> None:
    done = CliRunner().invoke(main, ["cycle", "cuckoo", "--section", "x"])
    assert done.exit_code == 2
    assert "There is no model 'cuckoo'" in " ".join(done.output.split())
