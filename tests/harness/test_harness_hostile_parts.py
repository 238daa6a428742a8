"""FMUs of others in machines and in the study: apart, unless somebody says otherwise, and no end like a success."""

import json
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

import pandas as pd
import pytest
from nursery import Ended, Nursery, nursery

from harness.app import execution
from harness.app.commands.one_run import run_study
from harness.fmu import Fmu
from harness.fmu.interface import Instances
from harness.fmu.remote import RemoteFmu
from harness.machine.file.machine_plan import ComponentPlan, Source
from harness.machine.file.read_file import components
from harness.machine.formats.ssp_xml import read_component, write_component
from harness.toml_file import TomlFile
from mechanism_fmu.fmu.disk.user_cache import record_build
from tests.harness.damaged import sound
from tests.harness.hostile.build import Harm, hostile
from tests.once import once

posix = pytest.mark.skipif(sys.platform == "win32", reason="hostile.c is for POSIX")


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return once(tmp_path_factory, "hostile", hostile) / "Hostile.fmu"


@pytest.fixture(scope="module")
def processes() -> Iterator[Nursery]:
    with nursery(COLUMNS="500") as processes:
        yield processes


def run(processes: Nursery, fmu: Path, folder: Path, harm: Harm, line: str = "", *more: str) -> Ended:
    folder.mkdir(exist_ok=True)
    file = folder / "two.toml"
    file.write_text(
        f"[run]\nstop_time = 1.0\nstep = 0.1\nalgorithm = 'jacobi'\n[record]\nformat = 'csv'\n"
        f"[component.wild]\nfile = '{fmu}'\n{line}\n[component.wild.set]\nharm = {int(harm)}\n"
        f"[component.tame]\nfile = '{fmu}'\n",
        encoding="utf-8",
    )
    ended = processes.run(["machine", "run", str(file), "-o", str(folder / "result"), *more])
    assert "Traceback" not in ended.err
    return ended


@posix
@pytest.mark.parametrize("harm", [Harm.EXIT_0, Harm.END_0, Harm.SEGFAULT])
def test_a_part_of_others_ends_its_own_process(harm: Harm, fmu: Path, processes: Nursery, tmp_path: Path) -> None:
    code, out, err = run(processes, fmu, tmp_path, harm)
    assert code == 1
    assert "wild failed at t = 0.5 s (advance): its process" in err
    assert out.count("In a process of its own, as no build of yours has made its FMU: wild, tame.") == 1
    assert pd.read_csv(tmp_path / "result" / "results.csv")["time [s]"].tolist() == pytest.approx(
        [0.1 * k for k in range(6)]
    )
    assert json.loads((tmp_path / "result" / "summary.json").read_text(encoding="utf-8"))["ending"] == "failed"


@posix
@pytest.mark.parametrize(
    ("line", "more"), [("process = false", ()), ("", ("--in-process",))], ids=["by its file", "by the command"]
)
@pytest.mark.parametrize("harm", [Harm.EXIT_0, Harm.ABORT_IN_FREE, Harm.MOVE])
def test_one_that_runs_here_is_watched(
    harm: Harm, line: str, more: tuple[str, ...], fmu: Path, processes: Nursery, tmp_path: Path
) -> None:
    code, out, err = run(processes, fmu, tmp_path, harm, line, *more)
    assert ("as no build of yours has made its FMU: tame." in out) is (not more)
    if harm is Harm.MOVE:
        assert code == 0, err
        assert (tmp_path / "result" / "report.html").is_file()
    else:
        assert code == 1
        assert "before the program did: the FMU crashed or ended it." in err
        assert "process = false" in err


@posix
def test_both_ways_give_the_same_numbers(fmu: Path, processes: Nursery, tmp_path: Path) -> None:
    results = []
    for name, more in (("apart", ()), ("together", ("--in-process",))):
        assert run(processes, fmu, tmp_path / name, Harm.NOTHING, "", *more).code == 0
        results.append(pd.read_csv(tmp_path / name / "result" / "results.csv"))
    assert len(results[0]) == 11
    pd.testing.assert_frame_equal(*results, check_exact=True)


@pytest.fixture
def own_and_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """An FMU that a build has recorded, and one with other bytes."""
    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path / "cache"))
    own, other = record_build(sound(tmp_path / "Own.fmu")), tmp_path / "Other.fmu"
    shutil.copy(own, other)
    with other.open("ab") as file:
        file.write(b"\n")
    return own, other


@pytest.mark.parametrize(
    ("line", "own_apart", "other_apart"),
    [("", False, True), ("process = true", True, True), ("process = false", False, False)],
)
def test_whose_part_runs_where(
    line: str, own_apart: bool, other_apart: bool, own_and_other: tuple[Path, Path], tmp_path: Path
) -> None:
    path = tmp_path / "machine.toml"
    path.write_text("".join(f"[component.{p.stem}]\nfile = '{p}'\n{line}\n" for p in own_and_other), encoding="utf-8")
    parts = {part.name: part for part in components(TomlFile.read(path), [])}
    assert (parts["Own"].foreign, parts["Other"].foreign) == (False, True)
    assert (parts["Own"].apart, parts["Other"].apart) == (own_apart, other_apart)


def test_what_is_built_for_a_machine_is_one_s_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path / "empty"))
    part = ComponentPlan("ratchet", Source(None, "ratchet"))
    assert not part.foreign
    assert not part.apart


def test_the_study_runs_an_fmu_of_others_apart(
    own_and_other: tuple[Path, Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    given: list[object] = []
    watched: list[bool] = []

    def studied(instances: Instances) -> str:
        given.append(instances)
        return "a study"

    def note(work: object, foreign: bool) -> int:
        watched.append(foreign)
        return work()  # type: ignore[operator, no-any-return]

    monkeypatch.setattr("harness.app.commands.one_run._studied", studied)
    monkeypatch.setattr("harness.app.commands.one_run._study_written", lambda _study, _folder: 0)
    monkeypatch.setattr(execution, "watched", note)
    own, other = own_and_other
    assert run_study(tmp_path / "a", own) == 0
    assert "process of its own" not in capsys.readouterr().out
    assert run_study(tmp_path / "b", other) == 0
    assert (
        "Other.fmu runs in a process of its own, as no build of yours has made it"
        in capsys.readouterr().out.replace("\n", " ")
    )
    assert run_study(tmp_path / "c", other, in_process=True) == 0
    assert [type(one) for one in given] == [Fmu, RemoteFmu, Fmu]
    assert watched == [False, True]


@pytest.mark.parametrize(("said", "taken_over"), [("true", True), ("false", None)])
def test_an_ssp_file_cannot_say_that_its_parts_run_here(said: str, taken_over: bool | None) -> None:
    plan = ComponentPlan("one", Source(Path("One.fmu")), True)
    element = Element("ssd:Component")
    write_component(element, plan)
    for own in element.iter():
        if "process" in own.attrib:
            own.set("process", said)
    assert read_component(element) == (taken_over, None)
