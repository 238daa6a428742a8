"""What an installation asks for: what compiles the engine, only where it is not compiled yet."""

import runpy
import shutil
from pathlib import Path

import pytest

from mechanism_fmu.fmu.disk.user_cache import keep
from mechanism_fmu.fmu.native.sources import (
    COMPILED,
    FILES,
    FOLDERS,
    SURFACE,
    fingerprint,
    is_compiled,
    is_of_these_sources,
)

ROOT = Path(__file__).parents[1]
LIBRARY = ROOT / "mechanism_fmu"
COMPILERS = {"numba", "ziglang"}


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The sources of the engine, and what the backend reads, in a folder that it is called in."""
    for name in (*FOLDERS, SURFACE):
        shutil.copytree(LIBRARY / name, tmp_path / "mechanism_fmu" / name, ignore=shutil.ignore_patterns("*.pyc"))
    for name in FILES:
        target = tmp_path / "mechanism_fmu" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(LIBRARY / name, target)
    for name in ("pyproject.toml", "README.md", "LICENSE", "setup.py", "build_fmu.py"):
        shutil.copy(ROOT / name, tmp_path)
    for name in ("harness", "models"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path / "mechanism_fmu"


def asked(kind: str) -> set[str]:
    backend = runpy.run_path(str(ROOT / "backend" / "engine_backend.py"))
    return {text.partition(">")[0].partition("=")[0] for text in backend[f"get_requires_for_build_{kind}"]()}


def compiled(library: Path) -> None:
    (library / COMPILED).mkdir(parents=True, exist_ok=True)
    keep(library / COMPILED / "engine.bc", b"an engine")
    (library / COMPILED / "sources").write_text(fingerprint(library) + "\n")


@pytest.mark.parametrize("kind", ["wheel", "editable"])
def test_what_compiles_the_engine_is_asked_for_until_it_is_compiled(kind: str, tree: Path) -> None:
    assert asked(kind) >= COMPILERS
    compiled(tree)
    assert not asked(kind) & COMPILERS
    (tree / "engine" / "vectors.py").write_text("# changed")
    assert asked(kind) >= COMPILERS


@pytest.mark.parametrize("damage", ["cut off", "gone", "its digest too"])
def test_what_is_damaged_is_compiled_anew(damage: str, tree: Path) -> None:
    compiled(tree)
    file = tree / COMPILED / "engine.bc"
    if damage == "cut off":
        file.write_bytes(file.read_bytes()[:-1])
    else:
        file.unlink()
    if damage == "its digest too":
        file.with_name("engine.bc.sha256").unlink()
    assert asked("editable") >= COMPILERS
    assert not is_compiled(tree)


@pytest.mark.parametrize("name", ["engine/vectors.py", "tables/sizes.py", "codes.py", "fmu/native/c/many.c"])
def test_an_engine_is_of_these_sources_until_one_changes(name: str, tree: Path) -> None:
    assert not is_of_these_sources(tree)
    compiled(tree)
    assert is_of_these_sources(tree)
    (tree / name).write_bytes((tree / name).read_bytes() + b"\n")
    assert not is_of_these_sources(tree)


def test_a_new_file_of_the_engine_and_a_damaged_mark_are_noticed(tree: Path) -> None:
    compiled(tree)
    (tree / "engine" / "new.py").touch()
    assert not is_of_these_sources(tree)
    (tree / COMPILED / "sources").write_bytes(b"\xff")
    assert not is_of_these_sources(tree)
