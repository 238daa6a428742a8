"""docs/how-to/periodic-motions.md: its program prints what it says, and its tables are what the commands print."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from pages import JOINTS, commands, examples, what_prints
from typer.testing import CliRunner

from harness.app.cli import main

ROOT = Path(__file__).parents[2]
PAGE = JOINTS.parent / "how-to" / "periodic-motions.md"
PRINTED = commands(PAGE)
_NUMBER = re.compile(r"-?\d+\.\d+(?:e-?\d+)?|\b\de-\d+")


@pytest.mark.slow
def test_its_program_prints_what_it_says() -> None:
    ((program, expected),) = examples(PAGE)
    assert what_prints(program, PAGE) == expected


def test_there_are_four_examples() -> None:
    assert [command.split()[1] for command, _ in PRINTED] == [
        "docs/examples/gallery/woodpecker.py",
        "pin_pallet",
        "cam_drive",
        "docs/examples/feed_ratchet.py",
    ]


@pytest.mark.parametrize(
    ("command", "kept"),
    [PRINTED[0], *(pytest.param(*pair, marks=pytest.mark.slow) for pair in PRINTED[1:])],
    ids=["woodpecker", "pin_pallet", "cam_drive", "feed_ratchet"],
)
def test_its_tables_are_what_the_command_prints(command: str, kept: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """But for the frames, and for residuals and errors, which are rounding."""
    monkeypatch.chdir(ROOT)
    done = CliRunner().invoke(main, shlex.split(command.replace("\\\n", " ")))
    assert done.exit_code == 0
    kept, printed = (_words(text) for text in (kept, done.stdout))
    assert _NUMBER.sub("#", kept) == _NUMBER.sub("#", printed)
    stated, found = ([float(number) for number in _NUMBER.findall(text)] for text in (kept, printed))
    assert len(stated) > 8
    np.testing.assert_allclose(stated, found, rtol=1e-6, atol=1e-7)


def _words(text: str) -> str:
    """Without frames, the line of residuals and iterations, and values that fall at the end of a table's cell."""
    lines = [line for line in text.splitlines() if not line.startswith(("End less", "unknowns;"))]
    return " ".join(re.sub(r"[^\x00-\x7f]+", " ", " ".join(lines)).split())
