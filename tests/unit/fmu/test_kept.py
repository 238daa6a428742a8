"""What is kept in the cache is used only as it was made, and only from a folder that nobody else can write to."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from mechanism_fmu.fmu import start
from mechanism_fmu.fmu.disk import user_cache
from mechanism_fmu.fmu.disk.user_cache import is_whole, keep
from mechanism_fmu.fmu.native import objects
from mechanism_fmu.fmu.native.link import TARGETS
from mechanism_fmu.model import MechanismError

#: What can become of a file.
DAMAGES: dict[str, Callable[[Path], object]] = {
    "cut off": lambda path: os.truncate(path, path.stat().st_size // 2),
    "emptied": lambda path: path.write_bytes(b""),
    "one bit": lambda path: path.write_bytes(bytes([path.read_bytes()[0] ^ 1]) + path.read_bytes()[1:]),
    "replaced": lambda path: path.write_bytes(b"somebody else's"),
    "gone": lambda path: path.unlink(),
    "digest gone": lambda path: path.with_name(f"{path.name}.sha256").unlink(),
    "digest emptied": lambda path: path.with_name(f"{path.name}.sha256").write_bytes(b""),
    "digest of bytes": lambda path: path.with_name(f"{path.name}.sha256").write_bytes(b"\xff\xfe"),
    "a folder": lambda path: (path.unlink(), path.mkdir()),
}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(objects, "is_bundled", lambda: False)
    return start.private_cache()


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_file_is_noticed(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "engine.o"
    keep(path, b"machine code")
    assert is_whole(path)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["engine.o", "engine.o.sha256"]
    DAMAGES[damage](path)
    assert not is_whole(path)


def test_a_kept_file_can_be_a_program(tmp_path: Path) -> None:
    keep(tmp_path / "a", b"", program=True)
    keep(tmp_path / "b", b"")
    assert [os.access(tmp_path / name, os.X_OK) for name in "ab"] == [True, sys.platform == "win32"]


@pytest.mark.parametrize("damage", [name for name in DAMAGES if name != "a folder"])
@pytest.mark.parametrize("which", ["x86_64-linux.o", "engine.h"])
def test_the_engine_is_compiled_again(damage: str, which: str, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled: list[Path] = []

    def emit(folder: Path, _report: Callable[[str, float], None]) -> None:
        compiled.append(folder)
        for target in TARGETS:
            keep(folder / f"{target.name}.o", b"object")
        keep(folder / "engine.bc", b"object")

    monkeypatch.setattr(objects, "_emit", emit)
    engine = objects.compiled_engine()
    assert objects.compiled_engine() == engine
    assert len(compiled) == 1
    DAMAGES[damage](engine.headers / which)
    assert not objects.engine_is_compiled()
    objects.compiled_engine()
    assert objects.engine_is_compiled()
    assert len(compiled) == 2


@pytest.mark.parametrize("damage", [name for name in DAMAGES if name != "a folder"])
def test_a_library_is_linked_again(damage: str, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One that is cut off would end the process with SIGBUS when it is loaded."""
    linked: list[str] = []

    def link(target: object, inputs: object, headers: object, path: Path) -> None:
        linked.append(path.name)
        path.write_bytes(b"library")

    engine = objects.Engine({target.name: cache / "x.o" for target in TARGETS}, cache)
    monkeypatch.setattr(objects, "link", link)
    monkeypatch.setattr(objects, "linked_with", lambda *_: {"": b""})
    path = objects._linked(engine, TARGETS[0])
    assert objects._linked(engine, TARGETS[0]) == path
    assert len(linked) == 1
    DAMAGES[damage](path)
    assert objects._linked(engine, TARGETS[0]).read_bytes() == b"library"
    assert len(linked) == 2


def test_the_compiler_takes_no_module_from_the_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It works in the cache's folder, where Python would look for modules first, also for compiled ones."""
    started: list[list[str]] = []

    def start(command: list[str], **_more: object) -> None:
        started.append(command)
        raise InterruptedError

    monkeypatch.setattr(subprocess, "Popen", start)
    with pytest.raises(InterruptedError):
        objects._emit(tmp_path, lambda *_: None)
    monkeypatch.undo()
    (tmp_path / "json.py").write_text("raise SystemExit(3)")
    ((python, *options),) = started
    options = options[: options.index("-m")]
    for chosen, code in ((options, 0), ([], 3)):
        assert (
            subprocess.run([python, *chosen, "-m", "json.tool", "--help"], cwd=tmp_path, capture_output=True).returncode
            == code
        )


posix = pytest.mark.skipif(sys.platform == "win32", reason="no modes of files there")


@posix
@pytest.mark.parametrize("mode", [0o777, 0o775, 0o757, 0o1777])
def test_a_cache_that_others_can_write_is_refused_with_the_way_out(mode: int, cache: Path, tmp_path: Path) -> None:
    cache.chmod(mode)
    with pytest.raises(PermissionError, match=r"can be written by others \(mode .*chmod go-w.*MECHANISM_FMU_CACHE"):
        start.private_cache()
    with pytest.raises(MechanismError, match=r"The cache directory cannot be used: .*can be written by others"):
        objects.compiled_engine()
    (tmp_path / "a.fmu").touch()
    assert not user_cache.was_built_here(user_cache.record_build(tmp_path / "a.fmu"))
    cache.chmod(0o755)
    assert start.private_cache() == cache


@posix
def test_a_cache_of_somebody_else_is_refused(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    owner = cache.stat().st_uid
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    with pytest.raises(PermissionError, match=f"belongs to user {owner}, not to {owner + 1}"):
        start.private_cache()


@posix
def test_a_new_cache_is_private_whatever_the_umask(tmp_path: Path) -> None:
    program = "import os; os.umask(0); from mechanism_fmu.fmu.start import private_cache; print(private_cache())"
    environment = os.environ | {"MECHANISM_FMU_CACHE": str(tmp_path / "new"), "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, check=True, capture_output=True, text=True)
    assert Path(done.stdout.strip()).stat().st_mode & 0o777 == 0o700


def test_a_build_is_known_by_its_bytes_alone(cache: Path, tmp_path: Path) -> None:
    path = tmp_path / "a.fmu"
    path.write_bytes(b"an FMU")
    assert not user_cache.was_built_here(path)
    assert user_cache.record_build(path) == path
    assert user_cache.was_built_here(path)
    path.rename(tmp_path / "b.fmu")
    assert user_cache.was_built_here(tmp_path / "b.fmu")
    (tmp_path / "b.fmu").write_bytes(b"an FMU.")
    assert not user_cache.was_built_here(tmp_path / "b.fmu")
    assert not user_cache.was_built_here(tmp_path / "none.fmu")
