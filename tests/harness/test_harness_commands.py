"""Exit codes of commands are those of their verdicts, and what each asks for is what it says; with a kept run."""

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from harness.app.commands import one_run
from harness.app.terminal import FAILED
from harness.errors import FmuError, UsageError
from harness.papers.study import indexing
from harness.run.checks import Check
from harness.run.experiment import Experiment, Run, perform
from harness.run.master import Ending, Outcome
from tests.replayed import EXPERIMENT, ReplayedFmu


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Experiment]:
    """Experiments that were asked for; each ends with the exit code 7, and its checks are those of the kept run."""
    seen: list[Experiment] = []

    def performed(fmu: Any, experiment: Experiment, then: Callable[[Run], int]) -> int:
        seen.append(experiment)
        then(perform(ReplayedFmu(), EXPERIMENT))  # type: ignore[arg-type]
        return 7

    monkeypatch.setattr(one_run, "_built_ratchet", lambda folder, purpose: folder / "Ratchet.fmu")
    monkeypatch.setattr(one_run, "open_fmu", lambda path, integrator=None: nullcontext(ReplayedFmu()))
    monkeypatch.setattr(one_run, "_performed", performed)
    return seen


def test_the_demo_is_the_papers_base_case(asked: list[Experiment], tmp_path: Path) -> None:
    """The FMU's defaults to 6 s; its exit code is that of the run."""
    assert one_run.run_demo(tmp_path) == 7
    assert asked == [Experiment(6.0, 1e-3)]
    assert (tmp_path / "report.html").is_file()


def test_the_full_demo_is_the_indexing_cycle(asked: list[Experiment], tmp_path: Path) -> None:
    assert one_run.run_cycle(tmp_path) == 7
    assert asked == [Experiment(34.0, 5e-3, indexing.VALUES, tmp_path / "drive.csv")]
    assert (tmp_path / "drive.csv").is_file()


def test_a_run_takes_the_fmus_default_experiment_unless_told(asked: list[Experiment], tmp_path: Path) -> None:
    path = Path("Ratchet.fmu")
    assert one_run.run_fmu(path, [], None, None, None, "steel", tmp_path) == 7
    assert one_run.run_fmu(path, ["restitution=0.3"], "1.2", "20ms", None, "steel", tmp_path) == 7
    told = ReplayedFmu().description
    assert [(one.stop_time, one.step, one.start_values) for one in asked] == [
        (told.stop_time, told.step, {}),
        (1.2, 0.02, {"restitution": 0.3}),
    ]


@pytest.mark.parametrize(("checks", "code"), [([], 0), ([Check("a", True, "")], 0), ([Check("a", False, "")], FAILED)])
def test_the_exit_code_of_a_run_is_that_of_its_verdicts(checks: list[Check], code: int, tmp_path: Path) -> None:
    whole = perform(ReplayedFmu(), EXPERIMENT)  # type: ignore[arg-type]
    assert all(check.passed for check in whole.checks)
    assert one_run._written(whole, tmp_path, checks) == code
    assert {"report.html", "results.csv", "impacts.csv"} <= {path.name for path in tmp_path.iterdir()}


def test_a_run_that_never_began_writes_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    whole = perform(ReplayedFmu(), EXPERIMENT)  # type: ignore[arg-type]
    outcome = Outcome(Ending.FAILED, 0.0, 0, FmuError("it cannot be assembled"))
    assert one_run._written(replace(whole, outcome=outcome, results=whole.results.head(0)), tmp_path) == FAILED
    assert not list(tmp_path.iterdir())
    assert "it cannot be assembled" in capsys.readouterr().err


def test_parameters_come_from_a_file_and_set_holds(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text("guided = false\nrestitution = 0.3  # 1\ndrive_torque = '2 N.mm'\nelastic_modulus = 1e21\n")
    found = one_run._settings_of(file, ["restitution = 0.5"])
    assert found == ["guided=false", "drive_torque=2 N.mm", "elastic_modulus=1e+21"]
    assert one_run._settings_of(None, []) == []
    file.write_text("a = 1\nb = [1]\n[c]\nd = 2\n")
    with pytest.raises(UsageError, match=r"(?s)toml:2: b: is no value; write name = value.*toml:3: c: is no value"):
        one_run._settings_of(file, [])
