"""The commands of docs/how-to/ked.md print what stands below them, but for the sizes of what only rounding leaves.

A line of three dots stands for lines that the page leaves out.
"""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "ked.md"
EXAMPLES = re.findall(r"```text\n\$ (mechanism-fmu ked [^\n]*)\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
#: Numbers that rounding makes, and which another processor makes otherwise; how many designs a search took.
_ROUNDING = re.compile(r"\d\.\de-\d\d( of [^;]*)?|of \d+ that were judged")
_NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")
#: Numbers may differ by this part where a search ends a little elsewhere on another processor.
_ALIKE = 1e-3


def test_the_page_shows_its_options_at_work():
    shown = " ".join(command for command, _ in EXAMPLES)
    for option in (
        "--synthesise",
        "--limit-deviation",
        "--limit-stress",
        "--fluctuation",
        "--friction",
        "--pin-radius",
    ):
        assert option in shown


@pytest.mark.slow  # tests/harness/test_harness_ked.py and test_harness_ked_options.py have the numbers
@pytest.mark.parametrize(("command", "expected"), EXAMPLES, ids=[command.split()[-1] for command, _ in EXAMPLES])
def test_the_command_prints_what_the_page_says(command: str, expected: str, tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-c", "from harness.app.cli import main; main()", *command.split()[1:]],
        cwd=tmp_path,
        env={**os.environ, "COLUMNS": "150", "PYTHONPATH": str(PAGE.parents[1])},
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    assert run.returncode == 0, run.stderr
    same = _alike if "--synthesise" in command else list.__eq__
    printed, begin = _plain(run.stdout), 0
    for part in re.split(r"^\.\.\.\n", expected, flags=re.MULTILINE):
        lines = _plain(part)
        places = range(begin, len(printed) - len(lines) + 1)
        found = next((k for k in places if same(printed[k : k + len(lines)], lines)), None)
        assert found is not None, "\n".join([*lines, "is not in", *printed])
        begin = found + len(lines)
    if "\n...\n" not in f"\n{expected}":
        assert begin == len(printed)


def _plain(text: str) -> list[str]:
    return [line.rstrip() for line in _ROUNDING.sub("0", text).strip().splitlines()]


def _alike(printed: list[str], expected: list[str]) -> bool:
    """Whether lines have the same words, and nearly the same numbers."""
    for here, there in zip(printed, expected, strict=True):
        if re.sub(r"\s", "", _NUMBER.sub("#", here)) != re.sub(r"\s", "", _NUMBER.sub("#", there)):
            return False
        numbers = zip(_NUMBER.findall(here), _NUMBER.findall(there), strict=True)
        if not all(math.isclose(float(a), float(b), rel_tol=_ALIKE) for a, b in numbers):
            return False
    return True
