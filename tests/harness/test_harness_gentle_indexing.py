"""The largest stress of an indexing cycle in the set-up of docs/examples/indexing.toml: that of the holding pawl."""

import shutil
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"

#: By number of teeth and wheel damping [N.m.s/rad], at steps of 2 ms: largest stress [Pa]. The last is the best design.
STRESSES = {(20, 0.1): 24919.0, (20, 0.3): 12134.0, (25, 0.2395): 9310.0, (25, 0.3): 7489.0, (25, 1.0537054): 1404.68}
HOLDING_PAWL = 2

SWEEP = """
[sweep]
method = "grid"

[vary.tooth_count]
values = [20, 25]

[vary.wheel_damping]
values = [0.1, 0.2395, 0.3, 1.0537054]

[record]
largest_impact = ["stress_max", "contact", "velocity", "wheel_speed", "wheel_speed_before"]
parameter = ["tooth_length"]
end = ["clicks"]
"""


@pytest.mark.slow
def test_the_holding_pawl_that_stops_the_wheel_leaves_the_largest_stress(tmp_path: Path) -> None:
    example = (EXAMPLES / "indexing.toml").read_text(encoding="utf-8")
    assert 'step = "2 ms"' in example
    (tmp_path / "sweep.toml").write_text(example[: example.index("[optimise]")] + SWEEP, encoding="utf-8")
    shutil.copy(EXAMPLES / "drive.csv", tmp_path)
    done = CliRunner().invoke(main, ["sweep", str(tmp_path / "sweep.toml"), "--fast", "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    found = pd.read_parquet(tmp_path / "out" / "results.parquet").set_index(["tooth_count", "wheel_damping"])
    for design, stress in STRESSES.items():
        row = found.loc[design]
        assert row["largest_impact.stress_max"] == pytest.approx(stress, rel=1e-2)
        assert row["largest_impact.contact"] == HOLDING_PAWL
        assert row["largest_impact.wheel_speed"] == pytest.approx(0.0, abs=1e-12)
        whole_speed = -row["largest_impact.wheel_speed_before"] * row["parameter.tooth_length"]
        assert row["largest_impact.velocity"] == pytest.approx(whole_speed, rel=1e-9)
        assert row["end.clicks"] == 2
