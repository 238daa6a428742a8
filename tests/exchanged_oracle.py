"""Oracles that can be exchanged: an environment variable names another file, with other numbers and other kinds.

In the project's own file every kind has its cases and every case its test. In another file, a kind without cases and a
kind without a test are skipped, each by name.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest


def oracle_path(variable: str, name: str) -> Path:
    """The file that the environment variable names, or the project's own."""
    return Path(os.environ.get(variable) or Path(__file__).parent / "data" / name)


def is_exchanged(variable: str) -> bool:
    """Whether the environment variable names another file."""
    return bool(os.environ.get(variable))


def of_kind(variable: str, kind: object, parameters: list[Any], arguments: int = 1) -> list[Any]:
    """The parameters of a kind; where another file has none, one that is skipped by name."""
    if parameters or not is_exchanged(variable):
        return parameters
    skip = pytest.mark.skip(reason=f"{os.environ[variable]} has no case of the kind {kind}")
    return [pytest.param(*[None] * arguments, marks=skip, id=f"no case of {kind}")]


def kinds_with_tests(variable: str, present: Iterable[object], known: Iterable[object]) -> list[Any]:
    """Each kind that a file has, for a test that it is known; in another file, an unknown one is skipped by name."""
    names, known_names = dict.fromkeys(map(str, present)), set(map(str, known))
    reason = "{file} has cases of the kind {kind}, for which this project has no test: its numbers are not compared"
    return [
        pytest.param(
            kind,
            id=kind,
            marks=[pytest.mark.skip(reason=reason.format(file=os.environ[variable], kind=kind))]
            if is_exchanged(variable) and kind not in known_names
            else [],
        )
        for kind in names
    ]
