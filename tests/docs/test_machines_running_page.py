"""The example of docs/how-to/machines-running.md runs as it stands there."""

import re
from pathlib import Path

import pandas as pd
import pytest

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "machines-running.md"


def test_the_example_runs(
    native_cam_drive_fmu: Path,
    native_ratchet_fmu: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text(encoding="utf-8")
    program = re.search(r"^## In Python\n.*?^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert program is not None
    code = program[1].replace("build/CamDrive.fmu", str(native_cam_drive_fmu))
    exec(code.replace("build/Ratchet.fmu", str(native_ratchet_fmu)), {"__name__": "__main__"})
    assert "Ending.COMPLETED" in capsys.readouterr().out
    times = pd.read_parquet("results.parquet")["time"]
    assert (times.iloc[0], times.iloc[-1]) == (0.0, 1.0)
    assert len(times) == 1 + 100 + 2  # the start, every tenth point, the impact and the point before it
