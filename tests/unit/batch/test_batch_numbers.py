"""A model's tables for many designs at once are those of each design alone, and what is refused is refused alike."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import models
from mechanism_fmu.batch.numbers import Numbers
from mechanism_fmu.batch.prepared import Prepared, impossible, out_of_limits, prepared
from mechanism_fmu.model import MechanismError, compile_mechanism
from mechanism_fmu.tables.layout import pack
from tests.parameter_sets import near_defaults, within_limits

READY: dict[str, Prepared] = {name: prepared(models.load(name).MODEL) for name in ("ratchet", "cam_drive")}


def columns(model, designs):
    return {p.name: np.array([getattr(values, p.name) for values in designs]) for p in model.parameters}


def alone(model, values):
    """The block of one design; None, and why the model refuses it ("": it cannot be calculated)."""
    try:
        return pack(compile_mechanism(model.build(values))), ""
    except MechanismError as error:
        return None, str(error)
    except (ArithmeticError, ValueError):
        return None, ""


@pytest.mark.parametrize("name", READY)
@settings(max_examples=15)
@given(data=st.data())
def test_tables_are_those_of_each_design_alone(name, data):
    ready, model = READY[name], READY[name].traced.model
    designs = data.draw(st.lists(near_defaults(model) | within_limits(model), min_size=1, max_size=3))
    numbers = Numbers(ready.traced, columns(model, designs), {})
    values = [np.broadcast_to(column, (len(designs),)) for column in numbers.of(e.value for e in ready.entries)]
    refused = impossible(ready.traced, numbers, ready.entries, len(designs))
    for k, design in enumerate(designs):
        block, refusal = alone(model, design)
        if block is None:
            assert refused[k] == refusal or not refusal
            continue
        if k in refused:
            assert "not finite" in refused[k]
            continue
        for entry, column in zip(ready.entries, values, strict=True):
            assert column[k].tobytes() == block[entry.word].tobytes(), entry.label


@pytest.mark.parametrize("name", READY)
def test_what_no_design_varies_is_calculated_once(name):
    ready, model = READY[name], READY[name].traced.model
    varied = {p.name: p.start for p in model.parameters} | {"restitution": np.array([0.0, 0.5, 1.0])}
    found = Numbers(ready.traced, varied, {}).of(e.value for e in ready.entries)
    assert 0 < sum(np.ndim(column) for column in found) < len(found) / 4


@pytest.mark.parametrize(
    ("name", "values", "message"),
    [
        ("tooth_count", [10.0, 10.5, 2.0], "is not a whole number"),
        ("guided", [1.0, 2.0, 0.5], "neither true"),
        ("drive_torque", [0.0, math.nan, 1e7], "not a finite number"),
        ("restitution", [1.0, -0.1, 1.1], "is below its limit; give at least 0"),
    ],
)
def test_values_out_of_their_limits_are_told_one_by_one(name, values, message):
    ready = READY["ratchet"]
    refused = out_of_limits(ready.traced.model, ready.mechanism.inputs, {name: np.array(values)})
    assert sorted(refused) == [1, 2]
    assert all(text.startswith(f"{name} = ") for text in refused.values())
    assert message in refused[1]
