"""The cases of benchmarks/peers, that their programs state the same problem, and what the page says first."""

from dataclasses import replace
from datetime import date
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from benchmarks.peers import __main__ as command, result
from benchmarks.peers.case import OURS, Point, Program, Vector, error, measure, overtaken, verdicts
from benchmarks.peers.cases import CASES
from benchmarks.peers.pages import FIGURE, PAGE, absent, ahead, page, picture
from benchmarks.peers.programs import PEERS, Peer, is_here, peers
from benchmarks.peers.result import Result

#: Each program of a case that is not the engine.
_WAYS = [
    pytest.param(name, program, id=f"{name}-{program.code}-{program.method.split()[0]}")
    for name, case in CASES.items()
    for program in case.programs
    if program.code != OURS
]


@cache
def exact(name: str) -> Vector:
    return CASES[name].reference()


def point(code: str, seconds: float, off: float, method: str = "m") -> Point:
    return Point(code, method, "tolerance 1e-04", seconds, off)


@pytest.mark.parametrize("name", CASES)
def test_the_engine_agrees_with_the_reference(name: str) -> None:
    case = CASES[name]
    assert case.programs[0].code == OURS
    assert measure(case.programs[0], 1e-9, exact(name), 1).error <= case.within


@pytest.mark.parametrize(("name", "program"), _WAYS)
def test_a_peer_states_the_same_problem(name: str, program: Program) -> None:
    """Its error falls from a coarse to a finer setting, and is small there."""
    if not is_here(program.code):
        pytest.skip(f"{program.code} is not installed")
    coarse, fine = program.settings[0], program.settings[2]
    off = [error(program.prepare(setting)(), exact(name)) for setting in (coarse, fine)]
    assert off[1] < 0.02
    assert off[1] < max(0.7 * off[0], 1e-12)


@pytest.mark.parametrize("name", CASES)
def test_the_floor_is_three_times_what_two_programs_differ(name: str) -> None:
    case = CASES[name]
    (scipy,) = (program for program in case.programs if program.code == "scipy")
    assert error(scipy.prepare(scipy.settings[-1])(), exact(name)) <= case.floor / 3


@pytest.mark.parametrize("name", CASES)
def test_what_is_left_out_has_a_reason(name: str) -> None:
    case = CASES[name]
    assert set(PEERS) <= {program.code for program in case.programs} | set(case.cannot)


def test_a_peer_is_compared_at_its_own_best_accuracy() -> None:
    points = [point(OURS, 1.0, 1e-3), point(OURS, 4.0, 1e-9), point("MuJoCo", 2.0, 1e-2), point("MuJoCo", 8.0, 1e-6)]
    (found,) = verdicts(points, 0.0)
    assert (found.peer.seconds, found.ratio, found.is_ahead) == (8.0, 2.0, False)
    (by_floor,) = verdicts(points, 1e-2)  # its coarse run is as good as the fine one there
    assert (by_floor.peer.seconds, by_floor.ratio) == (2.0, 2.0)


def test_where_a_peer_is_ahead_is_said_first() -> None:
    case = replace(next(iter(CASES.values())), floor=0.0)
    points = (
        point(OURS, 1.0, 1e-3),
        point(OURS, 4.0, 1e-9),
        point("scipy", 9.0, 1e-6),
        point("MuJoCo", 3.0, 1e-6),
        point("pymunk", 9.0, 1e-12),
        point("Exudyn", 0.5, 1e-2),
        point("Exudyn", 9.0, 1e-5),
    )
    result = Result(case, points)
    told = [(one.peer.code, one.is_ahead) for one in result.verdicts]
    assert told == [("pymunk", True), ("MuJoCo", True), ("scipy", False), ("Exudyn", False)]
    assert [one.peer.code for one in overtaken(points, 0.0)] == ["Exudyn", "MuJoCo", "pymunk"]
    text = page([result], [Peer("scipy", "1.0"), Peer("Exudyn", None)], date(2026, 11, 27))
    first = text.index("## Where a peer is ahead")
    assert first < text.index("pymunk (m, tolerance 1e-04) takes 9e+03 ms") < text.index("## Each peer")
    assert "this engine is not as accurate at any tolerance" in text
    rows = [line for line in text.splitlines() if line.startswith(f"| {case.title} |") and "**" in line]
    assert [row.split(" | ")[1] for row in rows] == ["pymunk, m", "MuJoCo, m"]
    assert "Exudyn is not installed" in text
    assert "At a coarser setting" in ahead([result])
    assert picture([result]).startswith("<svg")


def test_a_run_of_the_engine_that_ends_with_a_message_is_said() -> None:
    case = next(iter(CASES.values()))
    told = ahead([Result(case, (point(OURS, 1.0, np.inf), point(OURS, 2.0, 1e-9), point("scipy", 3.0, 1e-9)))])
    assert f"- {case.title}: at tolerance 1e-04." in told.partition("ends with a message")[2]
    assert "no peer either" in told


def test_a_run_without_a_number_is_infinitely_off() -> None:
    assert error(np.array([np.nan]), np.zeros(1)) == np.inf
    assert overtaken([point(OURS, 1.0, 1e-3), point("pymunk", 0.1, np.inf)], 0.0) == []


def test_the_page_has_every_case_and_peer() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for case in CASES.values():
        assert f"## {case.title}\n" in text
        for program in case.programs:
            assert f"| {program.code} | {program.method} | {program.labelled(program.settings[-1])} |" in text
    assert "[beside other programs](peers.md)" in (PAGE.parent / "index.md").read_text(encoding="utf-8")
    assert all(case.title in FIGURE.read_text(encoding="utf-8") for case in CASES.values())


def test_the_command_leaves_out_what_is_not_installed_and_refuses_an_unknown_case(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    case = CASES["ratchet"]
    programs = tuple(replace(program, settings=program.settings[:1]) for program in case.programs)
    monkeypatch.setattr(command, "CASES", {"ratchet": replace(case, programs=programs)})
    monkeypatch.setattr(result, "is_here", lambda code: code in (OURS, "scipy"))
    monkeypatch.setattr(command, "peers", lambda: [Peer("pymunk", None)])
    monkeypatch.setattr(command, "PAGE", tmp_path / "peers.md")
    monkeypatch.setattr(command, "FIGURE", tmp_path / "peers.svg")
    app = command.typer.Typer()
    app.command()(command.run)
    done = CliRunner().invoke(app, [])
    assert done.exit_code == 0
    assert absent(Peer("pymunk", None)) in done.output
    assert "scipy, RK45" in done.output
    assert (tmp_path / "peers.svg").is_file()
    assert absent(Peer("pymunk", None)) in (tmp_path / "peers.md").read_text()
    refused = CliRunner().invoke(app, ["wheel"])
    assert refused.exit_code == 2
    assert "there is no case" in refused.output


def test_versions_are_those_of_what_is_installed() -> None:
    assert [peer.code for peer in peers()] == list(PEERS)
    assert all(is_here(peer.code) for peer in peers() if peer.version)
