"""docs/how-to/identify-impacts.md: its program prints what it says, and its table is what the command prints."""

import re
from pathlib import Path

import numpy as np
from pages import JOINTS, examples, what_prints
from typer.testing import CliRunner

from harness.app.cli import main

PAGE = JOINTS.parent / "how-to" / "identify-impacts.md"
MEASURED = Path(__file__).parents[1] / "data" / "measured_impacts.csv"
_NUMBER = re.compile(r"-?\d+\.\d+")


def test_its_program_prints_what_it_says() -> None:
    ((program, expected),) = examples(PAGE)
    assert what_prints(program, PAGE) == expected


def test_its_table_is_what_the_command_prints() -> None:
    """But for the frames, and for the last digit, which another processor may round otherwise."""
    (kept,) = re.findall(r"<!-- table -->\n```text\n(.*?)```\n<!-- end -->", PAGE.read_text("utf-8"), re.DOTALL)
    done = CliRunner().invoke(main, ["identify", "impacts", str(MEASURED)])
    assert done.exit_code == 0
    kept, printed = (re.sub(r"[^\x00-\x7f]+", " ", text).split() for text in (kept, done.output))
    assert _NUMBER.sub("#", " ".join(kept)) == _NUMBER.sub("#", " ".join(printed))
    stated, found = ([float(number) for number in _NUMBER.findall(" ".join(text))] for text in (kept, printed))
    assert len(stated) > 50
    np.testing.assert_allclose(stated, found, rtol=0, atol=0.1001)


def test_the_last_line_of_the_command_is_in_its_program() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert text.count('mechanism = mechanism.with_impacts("stronge", restitution=0.535, friction=0.171)') == 2
