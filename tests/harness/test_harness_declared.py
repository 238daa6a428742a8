"""What an FMU declares to be analysed: read with care, for an FMU is somebody else's."""

import copy
import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from fake_slave import FakeFmu, FakeSlave

import models
from harness.analysis.analyses import Damage, Seen, Stress, Yielding, analysed, analyses_of
from harness.analysis.stress import beam_of
from harness.errors import FmuError
from harness.fmu.declared import FILE, NOTHING, Declared, read_declared
from harness.report.run_report import run_report
from harness.run.experiment import Experiment, perform
from mechanism_fmu.fmu.parts.resources import analysis
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.stress import STEEL_CARD, TableBeam
from tests.declared import RATCHET, STRUCK

MODEL = models.load("ratchet").MODEL
VARIABLES = {variable.name: variable for variable in variables_of(MODEL)}
DATA = json.loads(analysis(MODEL)[FILE])


def read(folder: Path, text: str | bytes | None) -> Declared:
    path = folder / "Ratchet.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", "")
        if text is not None:
            archive.writestr(FILE, text)
    return read_declared(path, VARIABLES)


def test_an_fmu_without_the_file_declares_nothing(tmp_path: Path) -> None:
    assert read(tmp_path, None) == NOTHING


def test_the_ratchet_s_is_read_whole(tmp_path: Path) -> None:
    found = read(tmp_path, json.dumps(DATA))
    assert found == RATCHET
    assert found.struck is not None
    assert (found.struck.variables, found.struck.held) == (("tooth_length", "tooth_apex_angle"), "wheel held")
    assert found.chain is not None
    assert (found.chain.contact, len(found.chain.outputs), len(found.chain.variables)) == (1, 8, 13)


TABLE: dict[str, Any] = {
    "kind": "TableBeam",
    "places": [0.0, "tooth_length"],
    "areas": [2e-4, 1e-4],
    "second_moments": [2e-9, 1e-9],
    "outer_fibres": [5e-3, "tooth_apex_angle"],
}


def test_a_beam_may_be_a_table_of_numbers_and_variables(tmp_path: Path) -> None:
    data = copy.deepcopy(DATA)
    data["analyses"][0]["beam"] = TABLE
    struck = read(tmp_path, json.dumps(data)).struck
    assert struck is not None
    assert struck.variables == ("tooth_length", "tooth_apex_angle")
    beam = beam_of(struck, {"tooth_length": 0.03, "tooth_apex_angle": 2e-3})
    assert beam == TableBeam((0.0, 0.03), (2e-4, 1e-4), (2e-9, 1e-9), (5e-3, 2e-3))
    with pytest.raises(FmuError, match=r"tooth_length and tooth_apex_angle describe no tooth: .* must ascend"):
        beam_of(struck, {"tooth_length": -0.03, "tooth_apex_angle": 2e-3})


WRONG: dict[str, tuple[Callable[[Any], object], str]] = {
    "format": (lambda data: data.update(format=2), "its format is 2, and this harness knows format 1"),
    "no list": (lambda data: data.update(analyses={}), "no list of analyses"),
    "kind": (lambda data: data["analyses"][0].update(kind="Magic"), "unknown kind 'Magic'"),
    "beam": (lambda data: data["analyses"][0]["beam"].update(kind="Rope"), "beam is of the unknown kind 'Rope'"),
    "no beam": (lambda data: data["analyses"][0].update(beam=3), "kind of ImpactStress is None, and no text"),
    "variable": (lambda data: data["analyses"][0]["beam"].update(length="x"), "variable 'x', which the FMU has not"),
    "number": (lambda data: data["analyses"][0]["beam"].update(length=True), "length of ImpactStress is True, neither"),
    "no table": (lambda data: data["analyses"][0].update(beam=TABLE | {"areas": 3.0}), "is 3.0, and no list"),
    "table": (lambda data: data["analyses"][0].update(beam=TABLE | {"places": [0, "x"]}), "'x', which the FMU has not"),
    "column": (lambda data: data["analyses"][0].update(beam=TABLE | {"areas": [0, []]}), "areas of ImpactStress is []"),
    "no column": (lambda data: data["analyses"][0].update(beam={"kind": "TableBeam"}), "is None, and no list"),
    "word": (lambda data: data["analyses"][0].update(name=""), "name of ImpactStress is '', and no text"),
    "contact": (lambda data: data["analyses"][1].update(contact="face"), "contact of SeriesCompliance is 'face'"),
    "output": (lambda data: data["analyses"][1]["wheel"].update(index="y"), "the variable 'y', which the FMU has not"),
    "link": (lambda data: data["analyses"][1].update(arm=None), "name of SeriesCompliance is None"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_used_is_an_objection(case: str, tmp_path: Path) -> None:
    data = copy.deepcopy(DATA)
    WRONG[case][0](data)
    found = read(tmp_path, json.dumps(data))
    assert (found.struck, found.chain) == (None, None)
    assert WRONG[case][1] in found.objection
    assert found.objection.endswith("Build the FMU again.")


@pytest.mark.parametrize("text", ["{", b"\xff\xfe", "[" * 100_000])
def test_no_json_is_an_objection(text: str | bytes, tmp_path: Path) -> None:
    assert "cannot be used" in read(tmp_path, text).objection


def test_an_objection_is_a_verdict_of_the_run() -> None:
    slave = FakeSlave([0.5])
    object.__setattr__(slave.description, "analysis", Declared(objection="It is odd."))
    run = perform(FakeFmu(slave), Experiment(1.0, 0.1))  # type: ignore[arg-type]
    (verdict,) = [check for check in run.checks if check.claim == "What is to be analysed is known"]
    assert (verdict.passed, verdict.evidence) == (False, "It is odd.")
    assert "It is odd." in run_report(run)


def test_the_list_of_analyses_is_what_is_declared() -> None:
    chain = RATCHET.chain
    assert chain is not None
    assert analyses_of(NOTHING, ["velocity"]) == ()
    assert analyses_of(RATCHET, ["velocity"]) == (Damage(STRUCK), Stress(STRUCK), Yielding(chain))
    # an FMU that does not report the jump
    assert analyses_of(RATCHET, ["time"]) == (Yielding(chain),)


def test_a_run_that_never_began_has_nothing_to_analyse() -> None:
    nothing = pd.DataFrame({"time": []})
    found = analysed(analyses_of(RATCHET, ["velocity"]), Seen({}, nothing, nothing, STEEL_CARD))
    assert (found.beam, found.damage, found.compliance, found.objection) == (None, None, (), "")


def test_nothing_declared_leaves_all_as_it_was() -> None:
    run = perform(FakeFmu(FakeSlave([0.5])), Experiment(1.0, 0.1))  # type: ignore[arg-type]
    found = analysed((), Seen({}, run.results, run.impacts, STEEL_CARD))
    assert found.impacts is run.impacts
    assert (found.beam, found.damage, found.compliance, found.objection) == (None, None, (), "")
