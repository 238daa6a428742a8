"""The short form of `python -m tests.faults`: each fault once, each command at least once."""

import os
import shutil
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from tests.faults import trials
from tests.faults.commands import Command, commands
from tests.faults.running import Place
from tests.faults.surroundings import as_nobody, clock_library, engine_cache, least_memory
from tests.faults.trials import Trial, Undisturbed

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits as Linux has them")

COMMANDS = {command.name: command for command in commands(40)}
Usual = Callable[[str], Undisturbed]


@pytest.fixture(scope="module")
def usual(tmp_path_factory: pytest.TempPathFactory) -> Usual:
    """A command as it is without faults, by its name."""
    known: dict[str, Undisturbed] = {}

    def found(name: str) -> Undisturbed:
        if name not in known:
            known[name] = trials.undisturbed(COMMANDS[name], Place(tmp_path_factory.mktemp("undisturbed")))
        return known[name]

    return found


def as_promised(trial: Trial) -> bool:
    assert (trial.lost, trial.broken) == (0, []), trial
    return True


def test_a_sweep_that_is_killed_goes_on(usual: Usual, tmp_path: Path) -> None:
    known = usual("sweep")
    assert len(known.recorded) == 40
    assert as_promised(trials.killed(known, Place(tmp_path), 0.0, results=10))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sweep --fast", "optimise", "machine run", "study ratchet"])
def test_others_that_are_killed(usual: Usual, tmp_path: Path, name: str) -> None:
    known = usual(name)
    assert known.recorded
    assert as_promised(trials.killed(known, Place(tmp_path), 0.0, results=1))


@pytest.mark.slow
def test_no_room_for_files(usual: Usual, tmp_path: Path) -> None:
    """Enough for the FMU, not for the report."""
    assert as_promised(trials.file_full(usual("sweep"), Place(tmp_path), 2_500_000))


@pytest.mark.slow
def test_too_little_memory(usual: Usual, tmp_path: Path) -> None:
    """Less than is imported: with a little more, OpenBLAS may ask for memory until it is killed."""
    assert as_promised(trials.out_of_memory(usual("sweep"), Place(tmp_path), round(0.95 * least_memory())))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sweep", "machine run"])
def test_two_writers(usual: Usual, tmp_path: Path, name: str) -> None:
    assert as_promised(trials.two_writers(usual(name), Place(tmp_path), 0.0))


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("gcc") is None, reason="no compiler for the clock")
def test_a_clock_that_is_set_back(usual: Usual, tmp_path: Path) -> None:
    set_back = partial(trials.clock_set_back, usual("sweep"), library=clock_library(tmp_path), after=1.0)
    assert as_promised(set_back(Place(tmp_path), back=3600.0))


@pytest.mark.slow
def test_a_folder_that_cannot_be_written_to_any_more(usual: Usual, tmp_path: Path) -> None:
    known, cache = usual("study ratchet"), engine_cache(tmp_path / "engine")
    with tempfile.TemporaryDirectory(prefix="faults-") as folder:  # others cannot enter the folders of pytest
        os.chmod(folder, 0o755)
        place = Place(Path(folder), cache)
        assert as_promised(as_nobody(partial(trials.read_only, known, moment=0.3 * known.took), place))


@pytest.mark.slow
def test_a_cache_that_goes(usual: Usual, tmp_path: Path) -> None:
    known = usual("sweep")
    place = Place(tmp_path, engine_cache(tmp_path / "cache"))
    assert as_promised(trials.cache_deleted(known, place, 0.8 * known.took))


def test_results_that_are_gone_or_others_are_noticed(tmp_path: Path) -> None:
    """What counts results would otherwise say that all is well whatever happens."""
    files = {"kept": "1", "gone": "2", "changed": "3"}
    command = Command("fake", (), "", lambda folder: {p.name: p.read_text() for p in folder.iterdir()}, (), True)
    usual = Undisturbed(command, 1.0, 0, files, {}, {})
    place = Place(tmp_path)
    place.results.mkdir()
    (place.results / "kept").write_text("1")
    (place.results / "changed").write_text("4")
    trial = Trial("fault", "fake", "")
    trials.keeps(trial, usual, place, files)
    assert (trial.kept, trial.lost) == (2, 2)
    assert trial.broken == ["recorded, but not as in an undisturbed run: ['changed']"]


def test_a_part_that_cannot_be_read_is_lost(tmp_path: Path) -> None:
    place = Place(tmp_path)
    (place.results / "parts").mkdir(parents=True)
    (place.results / "parts" / "000000001.parquet").write_bytes(b"half")
    trial = Trial("fault", "sweep", "")
    trials.keeps(trial, Undisturbed(COMMANDS["sweep"], 1.0, 0, {}, {}, {}), place, {1: "", 2: ""})
    assert trial.lost == 2
    assert "cannot be read" in trial.broken[0]
