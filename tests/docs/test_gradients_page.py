"""docs/how-to/gradients.md: its program and its commands print what it says."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from pages import JOINTS, commands, examples, what_prints
from typer.testing import CliRunner

from harness.app.cli import main

ROOT = Path(__file__).parents[2]
PAGE = JOINTS.parent / "how-to" / "gradients.md"
PRINTED = commands(PAGE)
#: Of the errors only that they are there: they are rounding.
_ERROR = re.compile(r"\b\de-\d+")
_NUMBER = re.compile(r"-?\d+\.\d+(?:e-?\d+)?")


def test_its_program_prints_what_it_says() -> None:
    ((program, expected),) = examples(PAGE)
    assert what_prints(program, PAGE) == expected


def test_it_is_no_longer_than_a_page() -> None:
    assert len(PRINTED) == 2
    assert len(PAGE.read_text(encoding="utf-8").splitlines()) <= 80


@pytest.mark.parametrize(("command", "kept"), PRINTED, ids=["stress", "friction"])
def test_its_commands_print_what_it_says(command: str, kept: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    done = CliRunner().invoke(main, shlex.split(command.replace("\\\n", " ")))
    assert done.exit_code == ("Error" in kept)
    kept, printed = (_ERROR.sub("!", " ".join(text.split())) for text in (kept, done.stdout + done.stderr))
    assert _NUMBER.sub("#", kept) == _NUMBER.sub("#", printed)
    stated, found = ([float(number) for number in _NUMBER.findall(text)] for text in (kept, printed))
    np.testing.assert_allclose(stated, found, rtol=1e-6)
