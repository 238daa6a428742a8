"""A tool: what to install for it, which forms it takes, and how it is run, in a process of its own."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tests.importers.asked import Asked

Values = dict[str, float]
#: [s]; none takes ten on a machine that is not busy.
_LONGEST = 200
_ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Tool:
    """A tool.

    Attributes:
        name: in the table.
        forms: keys of those that it takes.
        run: gives the outputs at the end of a run; is called in a process of its own.
        missing: why it cannot be run here and what to do about it; "" if it can.
        version: of the tool; "" while it is missing.
        otherwise: why it does not take the other forms.
        tolerance: of its numbers; more where it prints fewer digits than a double has.
    """

    name: str
    forms: tuple[str, ...]
    run: Callable[[Asked], Values]
    missing: Callable[[], str]
    version: Callable[[], str]
    otherwise: str = ""
    tolerance: float = 1e-12


class ToolError(Exception):
    """A tool that crashed, refused or went wrong, with what it said."""


def package_missing(package: str, module: str) -> str:
    """What is said where a package is not installed."""
    return "" if importlib.util.find_spec(module) else f"not installed: python -m pip install {package}"


def package_version(package: str) -> str:
    """Version of an installed package."""
    return importlib.metadata.version(package)


def hosted(key: str, wanted: Asked) -> Values:
    """The outputs by the tool of that key in a process of its own.

    Raises:
        ToolError: as of `values_of`.
    """
    return values_of([sys.executable, "-m", "tests.importers.tools", key], wanted)


def values_of(command: list[str], wanted: Asked) -> Values:
    """What a program writes into the file that is its last argument.

    Raises:
        ToolError: it did not come to its end; a crash behind the last step, at unloading, is one as well.
    """
    out = Path(wanted.folder, "values.json")
    try:
        done = subprocess.run(
            [*command, str(out)],
            input=wanted.to_json(),
            capture_output=True,
            text=True,
            check=False,
            timeout=_LONGEST,
            cwd=_ROOT,
        )
    except subprocess.TimeoutExpired as error:
        raise ToolError(f"did not end within {_LONGEST} s") from error
    said = f"{done.stdout[-2000:]}{done.stderr[-2000:]}".strip()
    if done.returncode:
        when = "after its last step" if out.is_file() else "on the way"
        raise ToolError(f"ended {when} with exit code {done.returncode}: {said}")
    if not out.is_file():
        raise ToolError(f"gave no values: {said}")
    values: Values = json.loads(out.read_text(encoding="utf-8"))
    return values
