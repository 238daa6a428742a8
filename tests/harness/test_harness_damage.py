"""From the impacts of a run to the damage of its tooth: by a unit whose impacts are given."""

import html
import json
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pandas as pd
import pytest
from fake_slave import FakeFmu, FakeSlave
from hypothesis import given, strategies as st
from typer.testing import CliRunner

from harness.analysis.stress import DAMAGE_UNITS, HEADINGS, card_of, damage_of_impacts, damage_row, stress_history
from harness.app.cli import main
from harness.app.commands.run_summary import show_ending
from harness.errors import UsageError
from harness.fmu import open_fmu
from harness.fmu.description import Variable
from harness.report.run_report import run_report
from harness.run.experiment import Experiment, Run, perform
from harness.run.results import write_run
from mechanism_fmu.stress import (
    CARDS,
    STEEL,
    STEEL_CARD,
    WedgeTooth,
    converged_modes,
    maximum_stress,
    ritz_modes,
    sequence_damage,
)
from tests.declared import STRUCK, TEETH
from tests.report_page import opened

TOOTH = WedgeTooth(length=0.033, apex_angle=0.61)
PERIOD = 2 * math.pi / ritz_modes(TOOTH, STEEL)[0].natural_frequency


class ToothSlave(FakeSlave):
    """A unit that describes a tooth; an impact at t has the velocity -2 t."""

    def __init__(self, impacts: Sequence[float] = ()) -> None:
        super().__init__(impacts)
        tooth = {"tooth_length": TOOTH.length, "tooth_apex_angle": TOOTH.apex_angle}
        variables = {
            name: Variable(name, 30 + k, "Real", "calculatedParameter", unit=("m", "rad")[k])
            for k, name in enumerate(tooth)
        }
        self.description = replace(self.description, variables=self.description.variables | variables, analysis=TEETH)
        self.values |= tooth


def run_of(impacts: Sequence[float], material: str = "steel") -> Run:
    experiment = Experiment(1.0, 0.1, material=card_of(material))
    return perform(FakeFmu(ToothSlave(impacts)), experiment)  # type: ignore[arg-type]


def test_damage_of_a_run_is_that_of_its_impacts() -> None:
    times = [0.3, 0.3 + 0.8 * PERIOD, 0.7]
    run = run_of(times)
    assert run.damage == sequence_damage(TOOTH, STEEL, STEEL_CARD.strength, times, [-2 * t for t in times])
    assert run.damage is not None
    assert run.damage.impacts == 3
    # The second comes while the first rings: more than each alone.
    assert run.damage.stress > run.impacts["stress_max"][:2].max()


def test_base_case_of_the_paper(ratchet_fmu: Path) -> None:
    with open_fmu(ratchet_fmu) as fmu:
        run = perform(fmu, Experiment(1.2, 0.1))
    assert run.damage is not None
    assert run.impacts["stress_max"][0] == pytest.approx(16080.32, rel=1e-6)
    # Converged modes: C = 1.013135 instead of 0.786452, at 0.714 of the length.
    assert run.damage.stress == pytest.approx(16080.32 * 1.013135 / 0.786452, rel=2e-6)
    assert run.damage.position == pytest.approx(0.714, abs=1e-3)
    assert run.damage.yield_safety == pytest.approx(235e6 / run.damage.stress, rel=1e-12)
    assert run.damage.time == pytest.approx(0.9399211769, abs=1e-5)


def test_one_impact_has_the_stress_of_the_table() -> None:
    run = run_of([0.5])
    assert run.damage is not None
    assert run.damage.stress == pytest.approx(run.impacts["stress_max"][0] * 1.013135 / 0.786452, rel=2e-6)


def test_material_changes_stress_and_strength() -> None:
    steel, other = run_of([0.5]), run_of([0.5], "42CrMo4")
    assert other.impacts["stress_max"][0] == pytest.approx(steel.impacts["stress_max"][0] * math.sqrt(2.1 / 2.06))
    assert steel.damage is not None
    assert other.damage is not None
    assert other.damage.damage < steel.damage.damage
    assert other.damage.yield_safety > 3 * steel.damage.yield_safety
    assert ", 42CrMo4, the paper's two Ritz modes" in html.unescape(run_report(other))


def test_impacts_of_one_instant_count_once_and_instants_of_one_time_each() -> None:
    table = pd.DataFrame({"time": [0.2, 0.5, 0.5, 0.5], "velocity": [1.0, -0.7, -0.7, 0.3], "instant": [1, 2, 2, 3]})
    found = damage_of_impacts(table, STRUCK, TOOTH, STEEL_CARD)
    assert found == sequence_damage(TOOTH, STEEL, STEEL_CARD.strength, [0.2, 0.5, 0.5], [1.0, -0.7, 0.3])
    without = damage_of_impacts(table.drop(columns="instant"), STRUCK, TOOTH, STEEL_CARD)
    assert without is not None
    assert without.impacts == 4


@given(st.lists(st.tuples(st.floats(-2.0, 2.0).filter(bool), st.integers(1, 4)), min_size=1, max_size=6), st.randoms())
def test_however_many_records_an_instant_has_it_counts_once(instants: list[tuple[float, int]], random: Random) -> None:
    rows = [
        {"time": 1e-5 * number, "velocity": velocity, "instant": number, "contact": random.randrange(3)}
        for number, (velocity, records) in enumerate(instants, 1)
        for _ in range(records)
    ]
    times = [1e-5 * number for number in range(1, len(instants) + 1)]
    found = damage_of_impacts(pd.DataFrame(rows), STRUCK, TOOTH, STEEL_CARD)
    velocities = [velocity for velocity, _ in instants]
    assert found == sequence_damage(TOOTH, STEEL, STEEL_CARD.strength, times, velocities)


def test_history_begins_with_the_first_impact_and_holds_the_largest_stress() -> None:
    run = run_of([0.3, 0.7])
    assert run.damage is not None
    time, stress = stress_history(run.impacts, STRUCK, TOOTH, STEEL_CARD, run.damage.position)
    assert (time[0], stress[0], stress[-1]) == (0.3, 0.0, 0.0)
    assert np.all(np.diff(time) >= 0)
    assert np.abs(stress).max() == run.damage.stress
    assert "bending stress [Pa]" in opened(run_report(run))


def test_run_without_tooth_or_impact_has_no_damage(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for run in (run_of([]), perform(FakeFmu(FakeSlave([0.5])), Experiment(1.0, 0.1))):  # type: ignore[arg-type]
        assert run.damage is None
        assert "Fatigue" not in run_report(run)
        show_ending(run, write_run(run, tmp_path))
        assert "Fatigue" not in capsys.readouterr().out
        assert json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["fatigue"] is None


def test_summary_tells_damage_material_and_sources(tmp_path: Path) -> None:
    run = run_of([0.5, 0.6], "SAE1015")
    write_run(run, tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    told = summary["fatigue"]
    assert run.damage is not None
    assert told["damage"] == run.damage.damage
    assert told["repeats_to_failure"] == pytest.approx(1 / told["damage"])
    assert told["material"]["name"] == summary["experiment"]["material"] == "SAE1015"
    assert told["material"]["fatigue_coefficient"] == 1020e6
    assert any("Dowling" in source for source in told["material"]["sources"])
    assert set(told) - {"material"} == set(summary["units"]["fatigue"]) == set(DAMAGE_UNITS)


def test_what_is_infinite_is_null(tmp_path: Path) -> None:
    run = run_of([0.5])
    still = damage_of_impacts(pd.DataFrame({"time": [0.5], "velocity": [0.0]}), STRUCK, TOOTH, STEEL_CARD)
    write_run(replace(run, damage=still), tmp_path)
    told = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["fatigue"]
    assert told["repeats_to_failure"] is None
    assert told["damage"] == 0.0


def test_terminal_and_report_show_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = run_of([0.5])
    assert run.damage is not None
    row = damage_row(run.damage, run.experiment.material)
    assert len(row) == len(HEADINGS)
    show_ending(run, write_run(run, tmp_path))
    shown, report = capsys.readouterr().out, html.unescape(run_report(run))
    assert "<h2>Fatigue of the tooth</h2>" in report
    for text in (shown, report):
        assert "smooth specimens, no notch at the root" in text
        assert all(cell in text for cell in row)
    assert "Bäumel" in report
    # 1 m/s is about 40 MPa.
    assert run.damage.stress == pytest.approx(maximum_stress(TOOTH, STEEL, 1.0, converged_modes(TOOTH, STEEL)).stress)
    for text in (shown, report):
        assert "Length over root height is" in text
    tooth = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["tooth"]
    assert tooth["length_over_root_height"] == pytest.approx(1 / math.tan(TOOTH.apex_angle))
    assert "beam theory" in tooth["beam_theory"]
    assert "beyond the yield strength" not in report


def test_stress_beyond_yield_is_told() -> None:
    table = pd.DataFrame({"time": [0.5], "velocity": [20.0]})
    run = run_of([0.5])
    assert "beyond the yield strength" in run_report(
        replace(run, damage=damage_of_impacts(table, STRUCK, TOOTH, STEEL_CARD))
    )


def test_numbers_of_runs_beyond_counting_are_not_printed() -> None:
    table = pd.DataFrame({"time": [0.5], "velocity": [1e-3]})
    found = damage_of_impacts(table, STRUCK, TOOTH, STEEL_CARD)
    assert found is not None
    assert found.repeats_to_failure > 1e30
    assert damage_row(found, STEEL_CARD)[4] == "> 1e+12"
    assert np.isfinite(found.fatigue_safety)


def test_unknown_material_is_refused_before_the_run(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"--material: there is no material 'wood'; there are steel, S355"):
        card_of("wood")
    result = CliRunner().invoke(main, ["run", str(tmp_path / "any.fmu"), "--material", "wood"])
    assert result.exit_code == 2
    assert "no material 'wood'" in " ".join(result.output.split())


def test_help_names_every_material() -> None:
    text = CliRunner().invoke(main, ["run", "--help"]).output
    for name in CARDS:
        assert name in text


def test_impacts_without_a_stress_model_are_a_verdict_and_cost_no_result() -> None:
    slave = ToothSlave([1.5e6])
    run = perform(FakeFmu(slave), Experiment(2e6, 1e6))  # type: ignore[arg-type]
    (verdict,) = [check for check in run.checks if check.claim == "The struck tooth has a stress model"]
    assert not verdict.passed
    assert "impacts without a stress model: impact velocity = -3e+06 m/s" in verdict.evidence
    assert (run.beam, run.damage, len(run.impacts)) == (None, None, 1)
