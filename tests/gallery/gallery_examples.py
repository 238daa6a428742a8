"""The mechanisms of docs/examples/gallery as the tests of the gallery want them."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np

from mechanism_fmu.model import Model
from mechanism_fmu.simulation import Simulation

GALLERY = Path(__file__).parents[2] / "docs" / "examples" / "gallery"


def model(name: str) -> Model:
    """What the file of an example sets as MODEL."""
    spec = importlib.util.spec_from_file_location(f"gallery_{name}", GALLERY / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    found = module.MODEL
    assert isinstance(found, Model)
    return found


def simulation(name: str, **values: float) -> Simulation:
    """An example with its default values and others, assembled at its start."""
    example = model(name)
    return Simulation(example.build(example.values(**values)))


def run(name: str, times: Any, **values: float) -> dict[str, Any]:
    """All outputs of an example at ascending times [s], by name, each an array of the shape of `times`."""
    running = simulation(name, **values)
    rows = []
    for time in times:
        running.advance(time)
        rows.append(running.read())
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}
