"""The two ways of docs/how-to/plug-it-into-your-tool.md to step an FMU by hand give the same motion."""

import re
import shutil
from pathlib import Path

import pytest

from harness.fmu import open_fmu

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "plug-it-into-your-tool.md"


def test_steps_by_hand_find_the_impact(
    ratchet_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    program, _exchange = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / "build").mkdir()
    shutil.copy(ratchet_fmu, tmp_path / "build" / "Ratchet.fmu")
    monkeypatch.chdir(tmp_path)

    exec(compile(program, str(PAGE), "exec"), {})

    said = capfd.readouterr().out
    (impact,) = re.findall(r"^impact at (\S+) s$", said, re.MULTILINE)
    (last,) = re.findall(r"^wheel_speed (\S+) rad/s$", said, re.MULTILINE)
    with open_fmu(ratchet_fmu) as fmu, fmu.instantiate("ratchet") as ratchet:
        ratchet.set({"tooth_count": 15, "drive_torque": 1.2e-3})
        ratchet.initialize(0.0, 2.0)
        for k in range(200):
            ratchet.step(k * 0.01, 0.01)
        speed, time = ratchet.get(["wheel_speed", "impact_time"])
    assert float(impact) == pytest.approx(time, rel=1e-9)
    assert float(last) == pytest.approx(speed, rel=1e-9)
