"""Machine code that numba keeps is used as it was written, or not at all."""

import os
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from mechanism_fmu.engine.compiler.machine_code import CheckedFiles


@dataclass(frozen=True)
class Command:
    """Runs a command where it is unpickled."""

    text: str

    def __reduce__(self) -> tuple[Any, ...]:
        return os.system, (self.text,)


def files(folder: Path) -> CheckedFiles:
    return CheckedFiles(cache_path=str(folder), filename_base="advance", source_stamp="today")


DAMAGES: dict[str, Callable[[Path], object]] = {
    "cut off": lambda path: os.truncate(path, path.stat().st_size // 2),
    "emptied": lambda path: path.write_bytes(b""),
    "one bit": lambda path: path.write_bytes(path.read_bytes()[:-2] + bytes([path.read_bytes()[-2] ^ 1]) + b"."),
    "replaced": lambda path: path.write_bytes(pickle.dumps(Command(f"touch {path.parent / 'was_here'}"))),
    "gone": lambda path: path.unlink(),
    "digest gone": lambda path: path.with_name(f"{path.name}.sha256").unlink(),
    "digest of bytes": lambda path: path.with_name(f"{path.name}.sha256").write_bytes(b"\xff"),
}


@pytest.mark.parametrize("which", ["advance.nbi", "advance.1.nbc"])
@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_code_is_not_read(damage: str, which: str, tmp_path: Path) -> None:
    files(tmp_path).save("key", ["machine code"] * 10)
    assert files(tmp_path).load("key") == ["machine code"] * 10
    DAMAGES[damage](tmp_path / which)
    assert files(tmp_path).load("key") is None
    assert not (tmp_path / "was_here").exists()
    files(tmp_path).save("key", ["compiled again"])
    assert files(tmp_path).load("key") == ["compiled again"]
