"""The WebAssembly module of a model, in node, against the same motion in Python: every bit of every row."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from mechanism_fmu.fmu.native.link import has_linker
from mechanism_fmu.fmu.native.web import web_module
from mechanism_fmu.fmu.parts.variables import variables_of
from tests.fmu.native.motions import CASES, continuous_outputs, model_of, motion
from tests.once import once

NODE = shutil.which("node")
pytestmark = [
    pytest.mark.skipif(NODE is None, reason="node is not installed"),
    pytest.mark.skipif(not has_linker(), reason="ziglang is not installed"),
]

TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}


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
    asked = {"given": [], "start": 0.0, "spacing": 0.01, "steps": 1, "reals": [], "flags": [], "wholes": []} | asked
    asked |= {"wasm": str(wasm), "token": token}
    program = Path(__file__).with_name("page_in_node.js")
    done = subprocess.run([NODE, program], input=json.dumps(asked), capture_output=True, text=True, check=True)
    answer = json.loads(done.stdout)
    answer["rows"] = np.array([float(x) for x in answer["rows"]]).reshape(-1, answer["width"] or 1)
    return answer


def given(model, values):
    found = {v.name: v for v in variables_of(model)}
    return [[found[n].value_reference, TYPES[found[n].type], value] for n, value in values.items()]


@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_that_of_python_to_the_bit(name, web):
    values, until, steps = CASES[name]
    model = model_of(name).MODEL
    continuous = continuous_outputs(model)
    references = [v.value_reference for v in continuous]
    spacing = until / steps
    one = in_node(*web(name), given=given(model, values), spacing=spacing, steps=steps, reals=references)
    other = motion(name)
    assert one["text"] == ""
    assert one["rows"].shape == other.shape
    np.testing.assert_array_equal(one["rows"], other)


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
