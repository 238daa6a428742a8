"""The engine is compiled by one process at a time, and whoever asks meanwhile waits for it."""

import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event

import pytest

from mechanism_fmu.fmu.disk.user_cache import alone, keep
from mechanism_fmu.fmu.native import objects
from mechanism_fmu.fmu.native.link import TARGETS


def unasked() -> None:
    pytest.fail("there is nobody to wait for")


def test_who_comes_second_is_told_and_waits(tmp_path: Path) -> None:
    done: list[str] = []
    inside, waiting = Event(), Event()

    def first() -> None:
        with alone(tmp_path, unasked):
            inside.set()
            waiting.wait(60)
            done.append("first")

    def second() -> None:
        inside.wait(60)
        with alone(tmp_path, waiting.set):
            done.append("second")

    with ThreadPoolExecutor(2) as pool:
        for running in [pool.submit(second), pool.submit(first)]:
            running.result()
    assert done == ["first", "second"]


def test_a_process_that_dies_keeps_nobody_waiting(tmp_path: Path) -> None:
    program = f"""
import time
from pathlib import Path
from mechanism_fmu.fmu.disk.user_cache import alone
with alone(Path({str(tmp_path)!r}), print):
    print("inside", flush=True)
    time.sleep(600)
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "inside\n"
        process.kill()
    with alone(tmp_path, unasked):
        pass


def test_where_there_are_no_locks_all_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def flock(*_of: object) -> None:
        raise OSError("no locks available")

    monkeypatch.setattr(pytest.importorskip("fcntl"), "flock", flock)
    with alone(tmp_path, unasked), alone(tmp_path, unasked):
        pass


def test_two_that_need_the_engine_compile_it_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    waiting = Event()
    compiled: list[Path] = []

    def emit(folder: Path, _report: Callable[[str, float], None]) -> None:
        compiled.append(folder)
        waiting.wait(60)
        for target in TARGETS:
            keep(folder / f"{target.name}.o", b"object")
        keep(folder / "engine.bc", b"object")

    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path))
    monkeypatch.setattr(objects, "is_bundled", lambda: False)
    monkeypatch.setattr(objects, "_emit", emit)
    told: list[str] = []

    def report(text: str, _done: float) -> None:
        told.append(text)
        waiting.set()

    with ThreadPoolExecutor(2) as pool:
        one, other = (pool.submit(objects.compiled_engine, report) for _ in range(2))
        assert one.result() == other.result()
    assert compiled == [one.result().headers]
    assert told == ["waiting for another process that does it"]
