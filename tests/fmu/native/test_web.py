"""The WebAssembly module of a model, in node, against the same motion in Python.

The C library of the browser's module has other sines than the system's: in their last digit, which step sizes amplify.
Impact times agree to 1e-12 s.
"""

import importlib
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.fmu.native.link import has_linker
from mechanism_fmu.fmu.native.web import web_module
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.simulation import Simulation
from tests.once import once

NODE = shutil.which("node")
pytestmark = [
    pytest.mark.skipif(NODE is None, reason="node is not installed"),
    pytest.mark.skipif(not has_linker(), reason="ziglang is not installed"),
]

#: Values other than the defaults; for how long [s], in how many steps.
CASES = {
    "ratchet": ({}, 6.0, 600),
    "cam_drive": ({"unilateral": True, "cam_speed_start": 25.0, "drive_stiffness": 0.0, "restitution": 0.3}, 1.0, 200),
    "geneva": ({}, 2.0, 400),
    "four_bar": ({"crank_speed_start": 6.0}, 2.0, 400),
    "slider_crank": ({"slider_friction": 0.1, "crank_speed_start": 12.0}, 1.0, 200),
}
TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}


def model_of(name):
    return importlib.import_module(f"models.{name}.model")


@pytest.fixture(scope="session")
def web(tmp_path_factory):
    """Of a model by name: file of its module, and token."""

    def made(name):
        def work(folder):
            module = web_module(model_of(name))
            (folder / "model.wasm").write_bytes(module.binary)
            (folder / "token").write_text(module.token)

        folder = once(tmp_path_factory, f"web_{name}", work)
        return folder / "model.wasm", (folder / "token").read_text()

    return made


def in_node(wasm, token, **asked):
    asked = {"given": [], "start": 0.0, "spacing": 0.01, "steps": 1, "reals": [], "flags": []} | asked
    asked |= {"wasm": str(wasm), "token": token}
    program = Path(__file__).with_name("page_in_node.js")
    done = subprocess.run([NODE, program], input=json.dumps(asked), capture_output=True, text=True, check=True)
    answer = json.loads(done.stdout)
    answer["rows"] = np.array([float(x) for x in answer["rows"]]).reshape(-1, answer["width"] or 1)
    return answer


def given(model, values):
    found = {v.name: v for v in variables_of(model)}
    return [[found[n].value_reference, TYPES[found[n].type], value] for n, value in values.items()]


def by_python(model, values, until, steps, names):
    """As `page_run`: rows at the points of the grid and behind impacts."""
    simulation = Simulation(model.build(model.values(**values)))

    def row(struck):
        found = simulation.read()
        return [simulation.time, struck, *(found[name] for name in names)]

    rows = [row(0.0)]
    for k in range(1, steps + 1):
        target = k * (until / steps)
        simulation.begin_step()
        while simulation.time < target:
            impacts = simulation.counters[codes.COUNT_IMPACTS]
            simulation.go_on(target, codes.STOP_AT_IMPACT)
            struck = float(simulation.counters[codes.COUNT_IMPACTS] > impacts)
            rows.append(row(struck))
    return np.array(rows)


@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n == "ratchet" else pytest.mark.slow) for n in CASES])
def test_the_motion_is_that_of_python(name, web):
    values, until, steps = CASES[name]
    model = model_of(name).MODEL
    outputs = [v for v in variables_of(model) if v.causality == "output" and v.type == "Real"]
    continuous = [v for v in outputs if "[" not in v.name and not v.name.startswith("impact")]
    references = [v.value_reference for v in continuous]
    spacing = until / steps
    one = in_node(*web(name), given=given(model, values), spacing=spacing, steps=steps, reals=references)
    other = by_python(model, values, until, steps, [v.name for v in continuous])
    assert one["text"] == ""
    assert one["rows"].shape == other.shape
    np.testing.assert_allclose(one["rows"][:, 0], other[:, 0], rtol=0, atol=1e-12)
    np.testing.assert_array_equal(one["rows"][:, 1], other[:, 1])
    off = np.abs(one["rows"] - other) / np.maximum(1e-6, np.abs(other).max(axis=0))
    assert off.max() < (1e-11 if name == "ratchet" else 1e-8)


def test_it_imports_nothing_and_is_small(web):
    wasm, token = web("ratchet")
    assert in_node(wasm, token)["imports"] == 0
    assert wasm.stat().st_size < 300_000


def test_it_refuses_in_words(web):
    wasm, token = web("ratchet")
    assert "is not this FMU's" in in_node(wasm, "another")["text"]
    model = model_of("ratchet").MODEL
    too_short = in_node(wasm, token, given=given(model, {"crank_length": 0.02}))
    assert "crank_length = 0.02 m is 0.046394 m too short: give more than 0.066394 m" in too_short["text"]
    assert len(too_short["rows"]) == 0
    none = in_node(wasm, token, given=given(model, {"wheel_inertia": -1.0}))
    assert "wheel_inertia" in none["text"]
    assert "-1" in none["text"]
