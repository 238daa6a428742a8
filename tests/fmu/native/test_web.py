"""Models as data in the WebAssembly module of all pages, in node, against Python: every bit of every row."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import models
from mechanism_fmu.fmu.native import objects
from mechanism_fmu.fmu.native.formulas import formulas
from mechanism_fmu.fmu.native.link import has_linker, surface
from mechanism_fmu.fmu.native.model_data import model_data
from mechanism_fmu.fmu.native.model_image import STEPS, model_image
from mechanism_fmu.fmu.native.web import web_model
from mechanism_fmu.fmu.own.prepare import load
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import compile_mechanism
from mechanism_fmu.model.trace import trace
from mechanism_fmu.tables.layout import pack
from tests.fmu.native.motions import CASES, continuous_outputs, motion_of
from tests.once import once
from tests.unit.fmu.test_native_formulas import SMALL

NODE = shutil.which("node")
pytestmark = [
    pytest.mark.skipif(NODE is None, reason="node is not installed"),
    pytest.mark.skipif(not has_linker(), reason="ziglang is not installed"),
]

GALLERY = Path(__file__).parents[3] / "docs" / "examples" / "gallery"
#: Examples whose forces follow laws of their own.
WITH_LAWS = ("door_closer.py", "engine.py", "governor.py")

TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}


def model_of(name):
    if name == SMALL.name:
        return SMALL
    return (load(GALLERY / name) if name.endswith(".py") else models.load(name)).MODEL


@pytest.fixture(scope="session")
def web(tmp_path_factory):
    """Of a model by name: the folder with the module of all pages and the model's image, and the token."""

    def made(name):
        def work(folder):
            module = web_model(model_of(name))
            (folder / "module.wasm").write_bytes(module.binary)
            (folder / "model.image").write_bytes(module.image)
            (folder / "token").write_text(module.token)

        folder = once(tmp_path_factory, f"web_{name}", work)
        return folder, (folder / "token").read_text()

    return made


def in_node(folder, token, **asked):
    asked = {"given": [], "start": 0.0, "spacing": 0.01, "steps": 1, "reals": [], "flags": [], "wholes": []} | asked
    asked |= {"wasm": str(folder / "module.wasm"), "image": str(folder / "model.image"), "token": token}
    program = Path(__file__).with_name("page_in_node.js")
    done = subprocess.run([NODE, program], input=json.dumps(asked), capture_output=True, text=True, check=True)
    answer = json.loads(done.stdout)
    answer["rows"] = np.array([float(x) for x in answer["rows"]]).reshape(-1, answer["width"] or 1)
    return answer


def given(model, values):
    found = {v.name: v for v in variables_of(model)}
    return [[found[n].value_reference, TYPES[found[n].type], value] for n, value in values.items()]


def in_both(name, web, values, until, steps):
    """The motion in the module, and in Python."""
    model = model_of(name)
    references = [v.value_reference for v in continuous_outputs(model)]
    one = in_node(*web(name), given=given(model, values), spacing=until / steps, steps=steps, reals=references)
    assert one["text"] == ""
    return one["rows"], motion_of(model, values, until, steps)


@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_that_of_python_to_the_bit(name, web):
    of_web, of_python = in_both(name, web, *CASES[name])
    assert of_web.shape == of_python.shape
    np.testing.assert_array_equal(of_web, of_python)


@pytest.mark.parametrize("name", [*models.available(), *WITH_LAWS])
def test_the_default_experiment_is_that_of_python_to_the_bit(name, web):
    model = model_of(name)
    of_web, of_python = in_both(name, web, {}, model.stop_time, round(model.stop_time / model.step_size))
    assert of_web.shape == of_python.shape
    np.testing.assert_array_equal(of_web, of_python)


@pytest.mark.parametrize("values", [{}, {"a": 1.7, "b": -3.1}, {"a": 0.0, "b": 2.0}])
def test_every_operation_is_that_of_python_to_the_bit(values, web):
    of_web, of_python = in_both(SMALL.name, web, values, 0.1, 10)
    assert np.unique(of_web[0]).size > 3
    np.testing.assert_array_equal(of_web, of_python)


def test_it_imports_nothing_and_is_small(web):
    folder, token = web("ratchet")
    assert in_node(folder, token)["imports"] == 0
    assert (folder / "module.wasm").stat().st_size < 270_000
    assert (folder / "model.image").stat().st_size < 90_000


def test_one_module_serves_all_models(web):
    one, another = (web(name)[0] / "module.wasm" for name in ("ratchet", "gear_train"))
    assert one.read_bytes() == another.read_bytes()


def test_nothing_is_compiled_for_a_model(web, monkeypatch):
    def refuse(*_):
        raise AssertionError("something is compiled")

    folder, _ = web("ratchet")
    for name in ("link", "_emit"):
        monkeypatch.setattr(objects, name, refuse)
    made = web_model(model_of("geneva"))
    assert made.binary == (folder / "module.wasm").read_bytes()
    assert b"wheel" in made.image


def test_its_operations_are_numbered_as_in_c():
    text = surface("loaded.c")[0].read_text(encoding="utf-8")
    (named,) = re.findall(r"enum \{([A-Z0-9_, ]*)\};", text)
    assert [name.lower() for name in named.replace(" ", "").split(",")] == list(STEPS)


def test_members_stand_in_the_order_of_the_structure():
    model = model_of("gear_train")
    traced = formulas(trace(model), pack(compile_mechanism(model.build(model.values()))))
    text = surface("model.h")[0].read_text(encoding="utf-8")
    structure = re.sub(r"/\*.*?\*/", "", text[: text.index("} Model;")].rpartition("typedef struct {")[2], flags=re.S)
    members = re.findall(r"(\w+)(?:\[16\])?\s*[,;]", structure)
    data = model_data(model, traced, "{token}", bytes(16))
    assert members == list(data)
    assert b"{token}\0" in model_image(data, traced)


def test_it_refuses_in_words(web):
    folder, token = web("ratchet")
    assert "is not this FMU's" in in_node(folder, "another")["text"]
    model = model_of("ratchet")
    too_short = in_node(folder, token, given=given(model, {"crank_length": 0.02}))
    assert "crank_length = 0.02 m is 0.046394 m too short: give more than 0.066394 m" in too_short["text"]
    assert len(too_short["rows"]) == 0
    folder, token = web(SMALL.name)
    much = in_node(folder, token, given=given(SMALL, {"a": 8.5}))
    assert "8.5 % is {much}: 2" in much["text"]
    folder, token = web("ratchet")
    none = in_node(folder, token, given=given(model, {"wheel_inertia": -1.0}))
    assert "wheel_inertia" in none["text"]
    assert "-1" in none["text"]
