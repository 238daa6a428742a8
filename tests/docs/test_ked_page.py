"""The command of docs/ked.md prints what stands below it, but for the sizes of what only rounding leaves."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "ked.md"
#: Numbers that rounding makes, and which another processor makes otherwise.
_ROUNDING = re.compile(r"\d\.\de-\d\d( of [^;]*)?")


@pytest.mark.slow  # tests/harness/test_harness_ked.py has the numbers
def test_the_command_prints_what_the_page_says(tmp_path: Path) -> None:
    text = PAGE.read_text(encoding="utf-8")
    found = re.search(r"```text\n\$ (mechanism-fmu ked [^\n]*)\n(.*?)```", text, re.DOTALL)
    assert found is not None
    run = subprocess.run(
        [sys.executable, "-c", "from harness.cli import main; main()", *found[1].split()[1:]],
        cwd=tmp_path,
        env={**os.environ, "COLUMNS": "130", "PYTHONPATH": str(PAGE.parents[1])},
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    assert run.returncode == 0, run.stderr
    assert _plain(run.stdout) == _plain(found[2])


def _plain(text: str) -> list[str]:
    return [line.rstrip() for line in _ROUNDING.sub("0", text).strip().splitlines()]
