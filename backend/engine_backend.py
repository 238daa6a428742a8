"""Setuptools' build backend, with what compiles the engine, of a wheel and of an editable install (PEP 517, 660)."""

from __future__ import annotations

import importlib.util
import runpy
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import (
    build_sdist as build_sdist,
    build_wheel as build_wheel,
    get_requires_for_build_sdist as get_requires_for_build_sdist,
    prepare_metadata_for_build_editable as prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel as prepare_metadata_for_build_wheel,
)

#: A backend is called in the root of the tree.
_LIBRARY = Path("mechanism_fmu")


def get_requires_for_build_wheel(config_settings: dict[str, Any] | None = None) -> list[str]:
    """What setuptools asks for, and what compiles the engine."""
    return [*build_meta.get_requires_for_build_wheel(config_settings), *_compilers()]


def get_requires_for_build_editable(config_settings: dict[str, Any] | None = None) -> list[str]:
    """The same; an engine that is compiled already, of these sources, asks for nothing more."""
    return [*build_meta.get_requires_for_build_editable(config_settings), *_compilers()]


def build_editable(
    wheel_directory: str, config_settings: dict[str, Any] | None = None, metadata_directory: str | None = None
) -> str:
    """Compile the engine into the tree, unless it is there, so that nothing is compiled later; then as setuptools does.

    Without what compiles it, which only an install without build isolation can lack, it is left to its first use.
    """
    setup = runpy.run_path("setup.py", run_name="backend")
    lacking = [name for name in setup["COMPILERS"] if importlib.util.find_spec(name) is None]
    if lacking:
        print(f"The engine is not compiled now, as {' and '.join(lacking)} cannot be imported here.")
    else:
        setup["write_engine"](Path.cwd(), _LIBRARY.resolve())
    return str(build_meta.build_editable(wheel_directory, config_settings, metadata_directory))


def _compilers() -> list[str]:
    """What the engine is compiled and linked with, in the project's own versions, unless it is compiled."""
    is_compiled: Callable[[Path], bool] = runpy.run_path(str(_LIBRARY / "fmu" / "native" / "sources.py"))["is_compiled"]
    if is_compiled(_LIBRARY):
        return []
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    # numpy and pythonfmu are imported with the library, and fmpy brings the headers of FMI
    needed = [text for text in project["dependencies"] if text.startswith(("numpy", "pythonfmu", "fmpy"))]
    return [*needed, *project["optional-dependencies"]["dev"]]
