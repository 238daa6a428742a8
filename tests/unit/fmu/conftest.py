"""Start modules of FMUs, loaded as in a new process, with a cache of their own."""

import importlib.util
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "mechanism_fmu"


@pytest.fixture
def load() -> Iterator[Callable[[Path, str], ModuleType]]:
    """Import the start module of a resources folder, as in a new process."""
    before, path = set(sys.modules), sys.path[:]

    def forget() -> None:
        for name in set(sys.modules) - before:
            if name.startswith(("mechanism_fmu_", "start_")):
                del sys.modules[name]

    def load(resources: Path, digest: str) -> ModuleType:
        forget()
        spec = importlib.util.spec_from_file_location(f"start_{digest}", resources / f"start_{digest}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    yield load
    forget()
    sys.path[:] = path
