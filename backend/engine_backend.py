"""Setuptools' build backend, with what compiles the engine of a wheel (PEP 517); an editable install compiles none."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import (
    build_editable as build_editable,
    build_sdist as build_sdist,
    build_wheel as build_wheel,
    get_requires_for_build_editable as get_requires_for_build_editable,
    get_requires_for_build_sdist as get_requires_for_build_sdist,
    prepare_metadata_for_build_editable as prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel as prepare_metadata_for_build_wheel,
)


def get_requires_for_build_wheel(config_settings: dict[str, Any] | None = None) -> list[str]:
    """What setuptools asks for, and what the engine is compiled and linked with, in the project's own versions."""
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    needed = [text for text in project["dependencies"] if text.startswith(("numba", "numpy", "pythonfmu"))]
    asked: list[str] = build_meta.get_requires_for_build_wheel(config_settings)
    return [*asked, *needed, *project["optional-dependencies"]["native"]]
