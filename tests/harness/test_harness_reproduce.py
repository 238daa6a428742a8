"""The command `reproduce`: rows that are real, numbers that are known, and the page that it printed."""

import math
import re
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import typer

from harness.app.cli import main
from harness.app.commands.papers_run import run_reproduce
from harness.errors import UsageError
from harness.papers.reproduce.bench import Bench, joint_deviations
from harness.papers.reproduce.figures.all_figures import FIGURES
from harness.papers.reproduce.me451.joint_rows import PARTS, PLACED, phi_by_hand, two_bodies
from harness.papers.reproduce.papers_page import markdown
from harness.papers.reproduce.pennestri.stress_rows import LAMBDAS, RATIOS, frequencies, largest
from harness.papers.reproduce.perform import ASSUMPTIONS, CHOICES, MISPRINTS, ROWS, chosen, perform
from harness.papers.reproduce.row import Document, Found, judged, within
from harness.papers.reproduce.wheel_by_hand import alpha_star, gamma_on_slope, slope_gap, solid_wheel
from harness.run.checks import Verdict
from mechanism_fmu.kinematics.equations import Equations

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
EVERYTHING = (*ROWS, *MISPRINTS, *ASSUMPTIONS, *CHOICES)
PLACES_OF_A_MACHINE = re.compile(r"/(work|tmp|home|root|Users)/")


@pytest.mark.parametrize("row", EVERYTHING, ids=lambda row: row.id)
def test_code_of_a_row_exists(row):
    assert row.code
    for path in row.code:
        assert (ROOT / path).is_file(), f"{row.id} points to {path}, which is not there"


@pytest.mark.parametrize("row", EVERYTHING, ids=lambda row: row.id)
def test_command_of_a_row_is_one_of_this_project(row):
    program, *words = shlex.split(row.shown_by)
    assert program == "mechanism-fmu"
    command = typer.main.get_command(main)
    while hasattr(command, "commands"):
        name = words.pop(0)
        command = command.commands[name]
    command.make_context(name, list(words))
    if name == "reproduce":
        assert chosen(words)
    if not row.command:
        assert row in chosen(words)


def test_ids_are_unique_and_begin_with_their_documents_letter():
    ids = [row.id for row in EVERYTHING]
    assert len(set(ids)) == len(ids)
    assert {row.document for row in ROWS} == set(Document)
    assert all(row.id.startswith("X-") for row in (*MISPRINTS, *ASSUMPTIONS))
    assert all(row.id.startswith("C-") for row in CHOICES)


@pytest.mark.parametrize(
    "needed",
    [
        *(f"P-eq{k}" for k in range(1, 17)),
        *("P-inverse", "P-D1", "P-Wb", "P-table1", "P-table2"),
        *(f"P-fig{k}" for k in range(1, 12)),
        *(f"P-contribution{k}" for k in (1, 2, 3)),
        *(f"E-eq{k}" for k in (1, 2, 3, 5, 7, 8, 10, 11, 12, 13, 14)),
        *(f"E-fig{k}" for k in range(1, 8)),
        *(f"E-case{k}" for k in (1, 2, 3)),
        *("E-larger", "E-slider", "E-structure", "E-winfrey", "E-freedoms", "E-strains"),
        *("P-efficiency", "P-partition", "P-identical", "P-cantilever", "S-rack-distance", "S-rack-slip"),
        *("S-eq1", "S-eq2", "S-3.4.1", "S-tangents", "S-gj", "S-book"),
        *("S-distance", "S-revolute-translational", "S-gears", "S-rack", "S-cam", "S-flat", "S-point"),
        *("X-inertia", "X-column6", "X-gamma", "X-pull", "X-rest"),
        *("C-gamma", "C-table2", "C-a1", "C-length", "C-velocity"),
    ],
)
def test_rows_that_were_listed_while_reading_are_there(needed):
    """A list by those who wrote the rows: it keeps rows from being lost, and proves no completeness."""
    assert needed in {row.id for row in EVERYTHING}


def test_what_text_and_tables_determine_of_the_figures_is_drawn():
    ids = {row.id for row in ROWS}
    assert {figure.row for figure in FIGURES} <= ids
    assert {f"P-fig{k}" for k in range(1, 12)} <= {figure.row for figure in FIGURES}


def test_a_row_fails_when_its_number_is_off():
    assert within(2e-3, 1e-3, "number").verdict is Verdict.FAILED
    assert within(math.nan, 1e-3, "number").verdict is Verdict.FAILED
    assert within(5e-4, 1e-3, "number").verdict is Verdict.REPRODUCED
    assert judged(False, "claim").verdict is Verdict.FAILED


def test_a_judgement_by_a_person_is_not_taken_for_a_calculation():
    assert judged(True, "claim").calculated
    assert within(0.0, 1.0, "number").calculated
    assert not Found("text", Verdict.TAKEN_OVER).calculated


NEEDS_A_NUMBER = {Verdict.REPRODUCED, Verdict.ANSWERED, Verdict.REDRAWN, Verdict.HOLDS, Verdict.DOES_NOT_HOLD}
NEEDS_A_NUMBER |= {Verdict.MISPRINT, Verdict.ASSUMPTION}


def test_no_judgement_on_the_page_says_that_something_comes_out():
    text = (DOCS / "papers-reproduced.md").read_text(encoding="utf-8")
    judged_by_a_person = set(re.findall(r"\*\*([^*|]+)\*\*\\\*", text))
    assert judged_by_a_person
    assert not judged_by_a_person & {str(verdict) for verdict in NEEDS_A_NUMBER}


def test_an_id_stands_for_its_row_only_and_a_beginning_for_all():
    assert [row.id for row in chosen(["E-eq1"])] == ["E-eq1"]
    assert [row.id for row in chosen(["p-fig1"])] == ["P-fig1"]
    assert {row.id for row in chosen(["E-eq"])} > {"E-eq1", "E-eq10", "E-eq14"}


def test_misprints_and_assumptions_belong_to_the_document_that_they_are_of():
    documents = {row.id: row.document for row in (*MISPRINTS, *ASSUMPTIONS)}
    assert documents["X-column6"] is Document.ERDMAN
    assert documents["X-cam"] is Document.ME451
    assert documents["X-rest"] is Document.PENNESTRI


def test_the_wedge_by_hand_is_the_one_of_the_paper():
    assert [round(value, 3) for value in LAMBDAS] == [1.535, 4.994]
    assert frequencies(2) == pytest.approx(LAMBDAS, rel=1e-12)
    assert pytest.approx((0.7754844, -1.3754844), abs=1e-7) == RATIOS
    assert largest() == (pytest.approx(0.786452, abs=1e-6), pytest.approx(0.3956, abs=1e-4))


@pytest.mark.parametrize("kind", PARTS)
def test_joints_are_closed_where_hands_place_their_bodies(kind):
    equations = Equations(two_bodies(PARTS[kind]), 0.0)
    assert phi_by_hand(equations, kind) < 1e-9
    place, free = PLACED[kind]
    assert len(place([0.1] * free)) == len(equations.start)


@pytest.mark.parametrize("kind", ["distance", "rack", "internal-gears"])
def test_a_joint_of_another_size_is_found_out(kind):
    sizes = {"distance": {"distance": 1.2}, "rack": {"radius_j": 0.6}, "internal-gears": {"radius_j": 0.7}}[kind]
    equations = Equations(two_bodies(replace(PARTS[kind], **sizes)), 0.0)
    assert phi_by_hand(equations, kind) > 1e-3


def test_the_wheel_of_table_2_by_its_shape():
    mass, inertia = solid_wheel(10, 90, 6.5e-3)
    assert mass == pytest.approx(5.6264, rel=1e-5)
    assert inertia == pytest.approx(32.7948e-3, rel=2e-4)


def test_a_wheel_of_many_small_teeth_is_nearly_a_disc():
    mass, inertia = solid_wheel(1000, 90, 0.0)
    assert inertia / (mass * 0.1**2 / 2) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("angle", [85, 90, 95, 100, 105])
def test_the_solved_start_is_on_the_slope(angle):
    assert slope_gap(angle, math.degrees(gamma_on_slope(angle))) == pytest.approx(0.0, abs=1e-15)


def test_shapes_of_fig_7():
    over = [(n, b) for n in (10, 15, 20, 25) for b in (85, 90, 95, 100, 105) if alpha_star(n, b) >= 90]
    assert over == [(10, 100), (10, 105), (15, 105)]


class Pendulum:
    """One row x^2 + y^2 - t^3, with a factor on its Jacobian, nu and gamma to be found out."""

    def __init__(self, wrong=(1.0, 1.0, 1.0)):
        self.wrong = wrong

    def at(self, q, time, qd=None):
        from mechanism_fmu.kinematics.equations import Rows

        rate = np.zeros(2) if qd is None else qd
        jacobian, nu, gamma = self.wrong
        return Rows(
            np.array([q @ q - time**3]),
            np.array([3 * time**2]) * nu,
            np.array([-2 * rate @ rate + 6 * time]) * gamma,
            2 * np.array([q]) * jacobian,
        )


@pytest.mark.parametrize("place", [None, 0, 1, 2])
def test_differences_find_what_is_wrong(place):
    wrong = np.ones(3)
    if place is not None:
        wrong[place] = 1.01
    found = joint_deviations(Pendulum(wrong), np.array([0.6, -0.4]), np.array([0.9, 0.3]), np.array([-0.5, 0.8]))
    assert (max(found) < 1e-9) == (place is None)
    if place is not None:
        assert found[place] > 1e-3


def test_some_rows_are_worked_with_their_numbers(tmp_path):
    assert run_reproduce(["E-eq2", "x-gamma", "C-steel"], tmp_path) == 0
    table = pd.read_csv(tmp_path / "rows.csv")
    assert list(table["id"]) == ["E-eq2", "X-gamma", "C-steel"]
    text = (tmp_path / "papers-reproduced.md").read_text(encoding="utf-8")
    assert "92.4260°" in text
    assert "integrals of unit loads" in text
    assert "X-gamma" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_an_id_that_is_none_is_refused_with_what_there_is(tmp_path):
    with pytest.raises(UsageError, match=r"No row's id begins with 'Q-9'.*P-eq7"):
        run_reproduce(["Q-9"], tmp_path)


def test_a_failed_row_is_a_failed_command(tmp_path, monkeypatch):
    from harness.app.commands import papers_run

    def perform_wrongly(asked, bench, on_row):
        made = perform(asked, bench, on_row)
        (result,) = made.choices
        wrong = type(result)(result.row, judged(False, "off"))
        return type(made)((), (), (), (wrong,), {}, False)

    monkeypatch.setattr(papers_run, "perform", perform_wrongly)
    assert run_reproduce(["C-steel"], tmp_path) == 1


def test_markdown_of_some_rows_needs_no_fmu():
    bench = Bench(lambda: pytest.fail("no row asked for it"))
    made = perform(["E-eq"], bench, lambda *_: None)
    assert not made.failed
    assert markdown(made).startswith("# Some rows")


@pytest.mark.slow
def test_the_page_is_what_the_command_prints(tmp_path):
    assert run_reproduce([], tmp_path) == 0
    made = (tmp_path / "papers-reproduced.md").read_text(encoding="utf-8")
    assert made == (DOCS / "papers-reproduced.md").read_text(encoding="utf-8")
    for figure in FIGURES:
        drawn = (tmp_path / "papers-reproduced" / f"{figure.name}.svg").read_text(encoding="utf-8")
        assert drawn == (DOCS / "papers-reproduced" / f"{figure.name}.svg").read_text(encoding="utf-8")


def test_the_page_names_no_place_of_a_machine_and_leaves_nothing_to_tests():
    text = (DOCS / "papers-reproduced.md").read_text(encoding="utf-8")
    assert not PLACES_OF_A_MACHINE.search(text)
    assert "in tests only" not in text
    assert f"**{Verdict.FAILED}**" not in text
    links = re.findall(r"\]\((?!http)([^)#]+)\)", text)
    assert links
    for link in set(links):
        assert (DOCS / link).exists(), link
