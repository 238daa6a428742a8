from pathlib import Path

import pytest

from mechanism_fmu.fmu.own.find import write_new


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with a file lever.py: the mechanism of `mechanism-fmu new`, in the old form."""
    monkeypatch.chdir(tmp_path)
    text = Path(__file__).with_name("old_lever.txt").read_text(encoding="utf-8")
    (tmp_path / "lever.py").write_text(text, encoding="utf-8")
    return tmp_path


@pytest.fixture
def new_folder(folder: Path) -> Path:
    """The current folder, with a file lever.py as `mechanism-fmu new` writes it."""
    (folder / "lever.py").unlink()
    write_new("lever", folder)
    return folder
