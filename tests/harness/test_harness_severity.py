"""Impacts of one instant, held wheels, and the comparison of impacts in the report."""

import math

import numpy as np
import pandas as pd
import pytest

from harness.analysis.impacts import body_held, one_of_each_instant
from harness.analysis.stress import STRESS_COLUMNS, with_stress, worst_impact
from harness.designs.task import Quantity, Task, When, columns_of, of_impacts, struck_in
from harness.fmu.description import Description
from harness.fmu.values import engineering
from harness.report.impact_sections import severity_section, stress_section
from harness.run.master import TimeGrid
from mechanism_fmu.stress import STEEL, STEEL_CARD, WedgeTooth, maximum_stress
from tests.declared import STRUCK, TEETH

STRUCK_FMU = Description("Fake", "Fake", "", {}, analysis=TEETH)
TOOTH = WedgeTooth(length=0.02, apex_angle=1.0)
UNITS = {"time": "s", "closing_speed": "m/s", "impulse": "N.s", "energy_lost": "J", "velocity": "m/s"} | STRESS_COLUMNS

#: The pawl's touch, the holding pawl that stops the wheel dead, and a blow on the face of a wheel that is held.
TABLE = pd.DataFrame(
    {
        "time": [1.0, 2.0, 2.0, 3.0],
        "instant": [1, 2, 2, 3],
        "contact": [1, 2, 1, 0],
        "closing_speed": [5e-6, 0.09, 0.01, 0.13],
        "impulse": [7e-7, 3e-3, 1e-4, 6e-3],
        "energy_lost": [2e-12, 1e-4, 1e-4, 4e-4],
        "velocity": [2e-8, 8e-4, 8e-4, 1e-20],
    }
)


def test_a_held_wheel_is_known_by_an_impulse_without_a_jump():
    assert body_held(TABLE, "velocity").tolist() == [False, False, False, True]
    no_impulse = TABLE.assign(impulse=0.0)
    assert not body_held(no_impulse, "velocity").any()
    assert not body_held(TABLE[["velocity"]], "velocity").any()


def test_a_held_wheel_has_a_remark_and_no_stress():
    found = with_stress(TABLE, STRUCK, TOOTH)
    assert found["remark"].tolist() == ["", "", "", "wheel held"]
    assert math.isnan(found["stress_max"][3])
    assert found["stress_max"][1] == maximum_stress(TOOTH, STEEL, 8e-4).stress
    assert list(found.columns[-4:]) == list(STRESS_COLUMNS)
    assert list(with_stress(TABLE.head(0), STRUCK, TOOTH).columns) == list(found.columns)


def test_the_worst_impact_is_that_with_the_largest_stress_though_another_closes_faster():
    found = with_stress(TABLE, STRUCK, TOOTH)
    assert worst_impact(found) == 1
    assert worst_impact(found.tail(1)) is None


def test_records_of_one_instant_count_once():
    assert one_of_each_instant(TABLE)["velocity"].tolist() == [2e-8, 8e-4, 1e-20]
    assert len(one_of_each_instant(TABLE.drop(columns="instant"))) == 4


@pytest.mark.parametrize(("rows", "stress"), [(slice(None), 8e-4), (slice(3, 4), None), (slice(0, 1), 2e-8)])
def test_the_largest_impact_of_a_design_is_one_impact(rows, stress):
    names = ("stress_max", "closing_speed", "contact")
    quantities = tuple(Quantity(When.LARGEST_IMPACT, name, "Real", "") for name in names)
    task = Task(TimeGrid.of(1.0, 0.1), {}, None, quantities, STEEL_CARD)
    part = TABLE[rows].reset_index(drop=True)
    found = of_impacts(
        task,
        columns_of(part),
        struck_in(task, STRUCK_FMU),
        {"tooth_length": TOOTH.length, "tooth_apex_angle": TOOTH.apex_angle},
    )
    if stress is None:
        assert found["largest_impact.stress_max"] is None
        return
    place = part.index[part["velocity"] == stress][0]
    assert found["largest_impact.stress_max"] == maximum_stress(TOOTH, STEEL, stress).stress
    assert found["largest_impact.closing_speed"] == part["closing_speed"][place]
    assert found["largest_impact.contact"] == part["contact"][place]


def test_the_report_sets_the_measures_side_by_side():
    page = severity_section(with_stress(TABLE, STRUCK, TOOTH), UNITS, STRUCK, ("slope", "face"))
    most = maximum_stress(TOOTH, STEEL, 8e-4).stress
    assert "Which impact stresses the tooth most" in page
    for said in (
        "closing speed, slope",
        "closing speed, face",
        "impulse, contact 2",
        "energy lost",
        "wheel held",
        "100.0%",
    ):
        assert said in page
    assert engineering(most, "Pa") in page
    # The fastest contact, the largest impulse and the most energy belong to the impact that leaves no stress.
    energy = page[page.index("<td>energy lost</td>") :]
    assert energy.index("wheel held") < energy.index("</tr>")


def test_without_contacts_and_with_one_impact_only():
    table = with_stress(TABLE.drop(columns=["contact", "impulse"]), STRUCK, TOOTH)
    assert "closing speed, contact" not in severity_section(table, UNITS, STRUCK)
    assert severity_section(table.head(1), UNITS, STRUCK) == ""
    assert severity_section(pd.DataFrame({"time": np.zeros(3)}), {"time": "s"}, STRUCK) == ""


def test_a_wheel_that_is_always_held_is_said_so():
    table = with_stress(TABLE.tail(1), STRUCK, TOOTH)
    assert "held in every impact" in stress_section(table, STRUCK, TOOTH, STEEL_CARD)
