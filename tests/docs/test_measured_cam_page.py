"""docs/how-to/measured-cam.md: its program prints what it says, and `check` says of it what stands there."""

import re
from pathlib import Path

from pages import JOINTS, examples, what_prints

from mechanism_fmu.fmu.own.report import report_on

PAGE = JOINTS.parent / "how-to" / "measured-cam.md"
((PROGRAM, PRINTED),) = examples(PAGE)


def test_its_program_prints_what_it_says() -> None:
    assert what_prints(PROGRAM, PAGE, {"__name__": "__main__"}) == PRINTED


def test_check_names_the_noise(tmp_path: Path) -> None:
    file = tmp_path / "cam.py"
    file.write_text(PROGRAM, encoding="utf-8")
    report = report_on(str(file))
    assert not report.mistakes
    stated = re.findall(r"```text\n(PointFollower .*?)\n```", PAGE.read_text(encoding="utf-8"))
    assert len(stated) == 1
    assert any(stated[0] in warning for warning in report.warnings)
