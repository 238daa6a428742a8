"""A user's file, lever.py, through the real command: what is said, and the exit code."""

import re
from pathlib import Path

from typer.testing import CliRunner

from harness.app.cli import main

#: What is said of every file in the old form: see test_own_new_form.py.
OLD_FORM = re.compile(r"Warning: lever.py: line \d+: \w+ '\w+' is written in the old form, .*? So are \d+ more\. ?")


def change(folder: Path, old: str, new: str) -> int:
    """Change the file, and tell the line."""
    path = folder / "lever.py"
    text = path.read_text()
    assert text.count(old) == 1, old
    path.write_text(text.replace(old, new))
    return text[: text.index(old)].count("\n") + 1


def build(*arguments: str, of: str = "lever.py") -> tuple[int, str]:
    """The exit code, and what is said on the error stream, in one line, but for the remark on the old form."""
    result = CliRunner().invoke(main, ["build", of, "-o", "out", *arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert "Traceback" not in result.output
    return result.exit_code, OLD_FORM.sub("", " ".join(result.stderr.split()))


def built(*arguments: str) -> str:
    """What is said of a file that is built."""
    code, said = build(*arguments)
    assert code == 0
    return said


def refused(*arguments: str) -> str:
    """What is said of a file that is refused."""
    code, said = build(*arguments)
    assert code == 1
    return said


def refused_at(line: int) -> str:
    """What is said of a file that is refused for one of its lines."""
    said, place = refused(), f"lever.py, line {line}: "
    assert said.startswith(place)
    return said.removeprefix(place)


def wrong_use(of: str) -> str:
    """What is said of a file that cannot be built at all."""
    code, said = build(of=of)
    assert code == 2
    return said
