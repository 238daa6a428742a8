"""The files that a command has written, without what is another each time: dates, durations, identities, folders."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pandas as pd

#: Entries of result files that differ from run to run, by their whole names.
_PASSING = re.compile(
    r"file|fmu|guid|token|(time|date|seconds|started|ended|created)(_\w+)?|\w+_(guid|token|sha256|digest|version|seconds)"
    r"|\w*version|\w*digest|sha256|process|host|path|command|duration|elapsed|time_spent|stress_code"
)
_GUID = re.compile(r"\{?[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}\}?")


def contents(folder: Path) -> dict[str, str]:
    """Text of every table and every file of values below a folder, by its place there."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.suffix == ".json":
            found[name] = json.dumps(_lasting(json.loads(path.read_text(encoding="utf-8"))), indent=1)
        elif path.suffix == ".parquet":
            found[name] = _table(pd.read_parquet(path))
        elif path.suffix in (".csv", ".txt", ".toml"):
            found[name] = path.read_text(encoding="utf-8")
    return {name: _GUID.sub("GUID", text).replace(str(folder), "FOLDER") for name, text in found.items()}


def _lasting(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _lasting(entry) for key, entry in value.items() if not _passes(key)}
    return [_lasting(entry) for entry in value] if isinstance(value, list) else value


def _table(frame: pd.DataFrame) -> str:
    lasting = [name for name in frame.columns if not _passes(name)]
    return "\n".join(repr(tuple(row)) for row in [lasting, *frame[lasting].itertuples(index=False, name=None)])


def _passes(name: str) -> bool:
    return name != "time" and bool(_PASSING.fullmatch(name.lower()))
