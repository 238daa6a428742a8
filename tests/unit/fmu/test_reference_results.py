"""Reference results: what the default experiment gives, in files that say what they are."""

import csv
import io
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace
from xml.etree import ElementTree

import pandas as pd
import pytest
from pendulum import MODEL

import models
from mechanism_fmu.fmu.parts.reference_results import FOLDER, reference_results, result_points
from mechanism_fmu.model import Body, Mechanism, Model, Output, Settings, TorsionSpring

RATCHET = models.load("ratchet").MODEL


@pytest.fixture(scope="module")
def files():
    return reference_results(RATCHET)


def test_the_manifest_names_what_lies_beside_it(files):
    root = ElementTree.fromstring(files[f"{FOLDER}/fmi-ls-manifest.xml"])
    ls = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert root.get(f"{ls}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    named = {element.get("role"): element.get("source") for element in root}
    assert named == {"result": "Ratchet_ref.csv", "parameter": "Ratchet_default.ssv"}
    assert set(files) == {f"{FOLDER}/fmi-ls-manifest.xml", *(f"{FOLDER}/{name}" for name in named.values())}


def test_results_are_those_of_a_program_that_shares_no_code(files):
    found = pd.read_csv(io.BytesIO(files[f"{FOLDER}/Ratchet_ref.csv"])).set_index("time")
    expected = pd.read_csv(models.available()["ratchet"] / "reference.csv").set_index("time")
    assert found.index[0] == 0.0
    assert found.index[-1] == 6.0
    assert len(found) == 61
    at = expected.reindex(found.index, method="nearest", tolerance=1e-9)
    for column in ("wheel_angle", "crank_angle", "pawl_angle"):
        assert found[column].to_numpy() == pytest.approx(at[column].to_numpy(), abs=1e-7)
    assert found["impact_time"].iloc[-1] == pytest.approx(0.9399211769, abs=5.1e-11)
    assert not [name for name in found.columns if "[" in name]


def test_every_row_has_as_many_cells_as_the_head(files):
    rows = list(csv.reader(io.StringIO(files[f"{FOLDER}/Ratchet_ref.csv"].decode())))
    assert {len(row) for row in rows} == {len(rows[0])}


def test_the_parameter_set_holds_all_parameters_with_their_types(files):
    root = ElementTree.fromstring(files[f"{FOLDER}/Ratchet_default.ssv"])
    ssv = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"
    found = {p.get("name"): (p[0].tag.removeprefix(ssv), p[0].get("value")) for p in root.iter(f"{ssv}Parameter")}
    assert list(found) == [parameter.name for parameter in RATCHET.parameters]
    for parameter in RATCHET.parameters:
        kind, text = found[parameter.name]
        assert kind == parameter.type
        assert (text == "true" if kind == "Boolean" else float(text)) == parameter.start


def test_the_same_model_gives_the_same_bytes(files):
    assert reference_results(RATCHET) == files


@pytest.mark.parametrize(
    ("stop", "step", "count", "second"),
    [(6.0, 0.01, 61, 0.1), (1.0, 1.0, 2, 1.0), (1.0, 0.3, 5, 0.3), (0.1, 1.0, 2, 0.1)],
)
def test_points_are_communication_points_from_0_to_the_end(stop, step, count, second):
    points = result_points(replace(MODEL, stop_time=stop, step_size=step))
    assert points[0] == 0.0
    assert points[-1] == stop
    assert len(points) == count
    assert points[1] == pytest.approx(second)
    assert all(later > earlier for earlier, later in pairwise(points))


def test_an_experiment_that_cannot_be_finished_leaves_no_results():
    def swings(_values: SimpleNamespace) -> Mechanism:
        return Mechanism(
            (Body("rotor", 1.0, 1.0, (0.0, 0.0, 1.0)),),
            forces=(TorsionSpring("spring", "rotor", stiffness=1e6),),
            outputs=(Output("angle", "rotor.angle", "", "rad"),),
            settings=Settings(max_internal_steps=1000),
        )

    assert reference_results(Model("Rotor", "", (), swings, stop_time=1e3, step_size=10.0)) == {}
    assert reference_results(Model("Rotor", "", (), swings, stop_time=1e-3, step_size=1e-4)) != {}


def test_what_is_only_rounding_is_left_out(files):
    """The paper's pawl comes to rest in the root: along the face it never slips, but for some 1e-12 m/s."""
    head = files[f"{FOLDER}/Ratchet_ref.csv"].decode().splitlines()[0].split(",")
    assert {"slope_slip_speed", "face_friction_force", "face_sticks"} <= set(head)
    assert "face_slip_speed" not in head
