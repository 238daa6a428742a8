"""What users, files, other hosts and the engine get, beside what it was: see tests/kept.py.

Parameters, inputs and outputs of all models with their start values, units and limits, and the tables that the engine
reads.
"""

import dataclasses
from typing import Any

import numpy as np
import pytest

import build_fmu
import models
from mechanism_fmu import model
from mechanism_fmu.model import compile_mechanism
from tests.kept import defaults_of, plain_data, same_as_kept


@pytest.mark.parametrize("name", sorted(models.available()))
def test_kept_interface_of_a_model(name: str) -> None:
    mechanism = build_fmu.mechanism(name)
    found = {
        "parameters": models.load(name).MODEL.parameters,
        "inputs": mechanism.inputs,
        "outputs": mechanism.outputs,
        "calculated": mechanism.calculated,
    }
    told = {kind: {port.name: _plain(port) for port in ports} for kind, ports in found.items()}
    assert told["parameters"]
    assert told["outputs"]
    same_as_kept(f"model_{name}.json", plain_data(told))


@pytest.mark.parametrize("name", sorted(models.available()))
def test_kept_tables_of_a_model(name: str) -> None:
    tables = compile_mechanism(build_fmu.mechanism(name))
    told = {name: np.asarray(value).tolist() for name, value in {**tables.columns, **tables.numbers}.items()}
    same_as_kept(f"tables_{name}.json", plain_data(told))


def test_kept_defaults_of_the_model() -> None:
    same_as_kept("defaults_model.json", plain_data(defaults_of(model)))


def _plain(port: Any) -> dict[str, Any]:
    found = dataclasses.asdict(port)
    found.pop("usual", None)  # of pages, no part of an FMU
    return {key: value for key, value in found.items() if isinstance(value, str | int | float | None)}
