from pathlib import Path

import pytest

from mechanism_fmu.fmu.own.find import write_new


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with a new file lever.py."""
    monkeypatch.chdir(tmp_path)
    write_new("lever", tmp_path)
    return tmp_path
