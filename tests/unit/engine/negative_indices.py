"""Runs short motions of models, with the engine as plain Python, on blocks whose views refuse negative indices.

python negative_indices.py "ratchet geneva"        (prints JSON: what the engine said, and how often a view was used)

What is compiled takes an index as it is (`engine/compiler/indices.py`): a negative one would reach outside its view.
"""

import json
import sys

import numpy as np

import models
from mechanism_fmu import codes
from mechanism_fmu.engine.run import engine_for
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import field_of, pack

#: Steps of co-simulation and of an importer [s]: few, because plain Python takes some 50 ms for one of the engine.
_STEPS, _STEP, _SHORT_STEP = 3, 1e-3, 1e-6


class Refusing(np.ndarray):
    """An array that counts how it is used, and takes no index from its end."""

    uses = 0

    def __getitem__(self, index):
        self._look(index)
        return super().__getitem__(index)

    def __setitem__(self, index, value):
        self._look(index)
        super().__setitem__(index, value)

    def _look(self, index):
        Refusing.uses += 1
        for one in index if isinstance(index, tuple) else (index,):
            if isinstance(one, int | np.integer) and one < 0:
                raise IndexError(f"the engine uses index {index} of a view of shape {self.shape}")


def block_of(name):
    model = models.load(name).MODEL
    return pack(compile_mechanism(model.build(model.values()))).view(Refusing)


def co_simulation(name):
    """A start, steps with new inputs, outputs, derivatives by inputs; what the engine says of each."""
    block = block_of(name)
    engine = engine_for(block)
    said = [engine.begin(0.0), engine.advance(0.0)]
    for k in range(1, _STEPS + 1):
        field_of(block, "inputs")[:] += 1e-4
        said.append(engine.advance(k * _STEP))
        engine.read_outputs()
        engine.read_output_rates()
    field_of(block, "input_seed")[:] = 1.0
    field_of(block, "asked")[:] = 1
    engine.respond()
    return said


def model_exchange(name):
    """Event mode at the start, and Euler's steps, each completed."""
    block = block_of(name)
    engine = engine_for(block)
    said = [engine.begin(0.0), engine.advance(0.0), engine.exchange(codes.EXCHANGE_EVENTS, 0.0)]
    for k in range(1, _STEPS + 1):
        said.append(engine.exchange(codes.EXCHANGE_RATES, (k - 1) * _SHORT_STEP))
        field_of(block, "y_end")[:] += _SHORT_STEP * field_of(block, "dy_end")
        said.append(engine.exchange(codes.EXCHANGE_INDICATORS, k * _SHORT_STEP))
        said.append(engine.exchange(codes.EXCHANGE_COMPLETED, k * _SHORT_STEP))
    said.append(engine.exchange(codes.EXCHANGE_EVENTS, _STEPS * _SHORT_STEP))
    return said


if __name__ == "__main__":
    found = {}
    for name in sys.argv[1].split():
        Refusing.uses = 0
        found[name] = [co_simulation(name), model_exchange(name), Refusing.uses]
    print(json.dumps(found))
