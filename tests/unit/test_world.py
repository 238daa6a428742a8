"""The published problems of benchmarks/world, and that their pages hold what the cases say."""

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from typer.testing import CliRunner

from benchmarks.world import __main__ as command
from benchmarks.world.case import SHOWN, Case, Known, Run, work
from benchmarks.world.cases import CASES, chain, clearance_four_bar, clearance_slider_crank, governor
from benchmarks.world.pages import FOLDER, Result, index

_SLOW = {"rockers", "n_four_bar"}


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name in _SLOW)) for name in CASES])
def test_a_case_is_as_near_as_it_says(name: str) -> None:
    """At the tighter tolerance; and no published digit is missed without a remark that says why."""
    case = CASES[name]
    found = case.run(SHOWN[-1])
    assert case.deviation(found) <= case.within
    assert case.remark or not case.unreached(found)


@pytest.mark.slow
@pytest.mark.parametrize("count", chain.COUNTS)
def test_digits_of_the_chain_are_what_lagranges_equations_give(count: int) -> None:
    found, looser = (chain.quantities(chain.angles(count, tolerance)) for tolerance in (1e-13, 1e-12))
    np.testing.assert_allclose(found, looser, rtol=1e-12)
    np.testing.assert_allclose(found, chain.BY_ANGLES[count], rtol=1e-12)


@pytest.mark.slow
def test_digits_of_the_governor_are_what_lagranges_equations_give() -> None:
    np.testing.assert_allclose(governor.by_lagrange(), governor.BY_LAGRANGE, rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("case", [clearance_slider_crank, clearance_four_bar])
def test_digits_are_those_of_flights_between_impacts(case: ModuleType) -> None:
    assert np.array(case.second_formulation()) == pytest.approx(np.array(case.FOUND), rel=1e-9)


def test_the_inertia_of_the_governor_grows_as_its_slope_says() -> None:
    """A parabola: central differences are exact but for rounding."""
    grown = governor.inertia_over(1.6) - governor.inertia_over(1.4)
    assert grown / 0.2 == pytest.approx(governor.slope_over(1.5), rel=1e-13)


def test_a_published_value_is_reached_to_half_a_unit_of_its_last_digit() -> None:
    known = Known("length", "m", "1.250", "published")
    assert [known.is_reached(value) for value in (1.2504, 1.2506, 1.2494)] == [True, False, False]
    assert Known("length", "m", 1.25, "closed form").is_reached(7.0) is None
    assert known.deviation(1.0) == 0.2
    assert Known("drift", "J", 0.0, "closed form").deviation(-1e-9) == 1e-9


def test_work_falls_with_the_tolerance_and_precision_rises() -> None:
    case = CASES["pendulum"]
    coarse, fine = (work(case, tolerance, 1) for tolerance in (1e-6, 1e-10))
    assert coarse.steps < fine.steps / 3
    assert coarse.deviation > 100 * fine.deviation


def test_the_index_has_every_case_with_its_page() -> None:
    text = (FOLDER / "index.md").read_text(encoding="utf-8")
    for name, case in CASES.items():
        assert f"[{case.title}]({name}.md)" in text
        page = (FOLDER / f"{name}.md").read_text(encoding="utf-8")
        assert all(f"| {known.name} [{known.unit}] |" in page for known in case.known)
        assert (FOLDER / f"{name}.svg").is_file()


def made(value: float, within: float) -> Case:
    known = (Known("answer", "1", "42.0", "published"),)
    return Case(
        name="answer",
        title="Answer",
        statement="A question.",
        source="A book",
        known=known,
        run=lambda _: Run((value,), 1),
        model=made,
        within=within,
        remark="Why not.",
    )


@pytest.mark.parametrize(("value", "code"), [(42.0, 0), (43.0, 1)])
def test_the_command_writes_pages_and_tells_what_is_missed(
    value: float, code: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(command, "CASES", {"answer": made(value, 1e-3)})
    monkeypatch.setattr(command, "FOLDER", tmp_path)
    app = command.typer.Typer()
    app.command()(command.run)
    done = CliRunner().invoke(app, [])
    assert done.exit_code == code
    assert ("missed" in done.output) is bool(code)
    row = f"| answer [1] | {value:.16g} | {value:.16g} | 42.0 | published |"
    assert row in (tmp_path / "answer.md").read_text()
    assert f"| {1 - code} of 1 |" in (tmp_path / "index.md").read_text()
    assert CliRunner().invoke(app, ["question"]).exit_code == 2


def test_an_index_without_published_values_says_so() -> None:
    case = CASES["pendulum"]
    found = case.run(1e-6)
    assert "| none |" in index([Result(case, (found, found), ())], command.datetime.now(command.UTC).date())
