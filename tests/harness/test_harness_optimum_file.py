"""The file of an optimum: what it means, and its mistakes."""

from pathlib import Path

import pytest
from fake_slave import fake_description

from harness.designs.optimum_file import CONTINUOUS, MIXED, Around, Optimum, read_optimum
from harness.errors import UsageError
from harness.toml_file import TomlFile

GOOD = """\
[fmu]
file = "Fake.fmu"

[optimise]
minimise = "end.wheel_angle"
count = 100

[vary.tooth_slope_angle]
from = 85
to = 105
unit = "deg"

[vary.restitution]
from = 0
to = 0.5

[constraint."max.wheel_angle"]
at_least = 10
unit = "deg"

[constraint."end.impact_count"]
at_least = 1
at_most = 3

[sensitivity]
count = 64

[record]
first_impact = ["time"]
"""


def read(folder: Path, text: str) -> Optimum:
    path = folder / "best.toml"
    path.write_text(text, encoding="utf-8")
    return read_optimum(TomlFile.read(path), fake_description())


def test_an_optimum_needs_no_constraints_and_no_sensitivity(tmp_path: Path) -> None:
    begin, end = GOOD.index("[constraint"), GOOD.index("[record]")
    optimum = read(tmp_path, GOOD[:begin] + GOOD[end:])
    assert optimum.goal.constraints == ()
    assert optimum.around is None
    assert optimum.total == 100


def test_a_good_file(tmp_path: Path) -> None:
    optimum = read(tmp_path, GOOD)
    assert [quantity.column for quantity in optimum.task.quantities] == [
        "end.wheel_angle",
        "max.wheel_angle",
        "end.impact_count",
        "first_impact.time",
    ]
    angle, count = optimum.goal.constraints
    assert angle.at_least == pytest.approx(0.17453292519943295)
    assert angle.at_most is None
    assert (count.at_least, count.at_most) == (1.0, 3.0)
    assert (optimum.method, optimum.count, optimum.seed) == (CONTINUOUS, 100, 0)
    assert optimum.around == Around(64, 0.1)
    assert optimum.total == 100 + 64 * 4


def test_what_has_whole_numbers_is_mixed(tmp_path: Path) -> None:
    text = GOOD.replace("[vary.restitution]\nfrom = 0\nto = 0.5", "[vary.tooth_count]\nfrom = 10\nto = 25")
    assert read(tmp_path, text).method == MIXED


def test_along_gradients_what_tells_the_events_is_recorded_too(tmp_path: Path) -> None:
    """Counts and switches, at the end; the identity of files without gradient is what it was."""
    plain, optimum = (
        read(tmp_path, GOOD.replace("count = 100", f"count = 100\n{more}")) for more in ("", "gradient = true")
    )
    assert (plain.gradient, plain.events) == (False, ())
    assert "gradient" not in plain.how[1]
    assert optimum.gradient
    assert optimum.how[1]["gradient"] is True
    assert {one.type for one in optimum.events} == {"Integer", "Boolean"}
    assert "end.impact_count" not in [one.column for one in optimum.events]  # the constraint has it
    assert optimum.task.quantities == (*plain.task.quantities, *optimum.events)


MISTAKES = {
    "two goals": (
        "count = 100",
        'count = 100\nmaximise = "end.wheel_angle"',
        '5: optimise.minimise: either minimise or maximise must be given, as in minimise = "end.wheel_angle"',
    ),
    "no goal": (
        'minimise = "end.wheel_angle"\n',
        "",
        '4: optimise.minimise: either minimise or maximise must be given, as in minimise = "end.wheel_angle"',
    ),
    "goal without a time": (
        '"end.wheel_angle"',
        '"wheel_angle"',
        "5: optimise.minimise: 'wheel_angle' is no quantity; write when and what, as in \"end.wheel_angle\"; when "
        "is one of end, max, min, first_impact, largest_impact, all_impacts, parameter",
    ),
    "unknown goal": (
        '"end.wheel_angle"',
        '"end.wheel_angel"',
        "5: optimise.minimise: Fake has no input or output 'wheel_angel'. Did you mean wheel_angle?",
    ),
    "unknown quantity of a constraint": (
        '"end.impact_count"',
        '"end.impact_cound"',
        "21: constraint.end.impact_cound: Fake has no input or output 'impact_cound'. Did you mean impact_count "
        "or impacts_lost or impact?",
    ),
    "wrong unit of a constraint": (
        'at_least = 10\nunit = "deg"',
        'at_least = 10\nunit = "mm"',
        "18: constraint.max.wheel_angle.at_least: wheel_angle = '10 mm': unit 'mm' does not measure the same quantity; "
        "these fit: rad, deg, also with SI prefixes on any symbol (m, k, ...)",
    ),
    "limits reversed": (
        "at_most = 3",
        "at_most = 0",
        "22: constraint.end.impact_count.at_least: = 1 is above at_most = 0; nothing can keep both",
    ),
    "constraint without a limit": (
        "at_least = 10\n",
        "",
        "17: constraint.max.wheel_angle.at_least: is missing; give at_least, at_most, or both",
    ),
    "limit as a text": (
        "at_most = 3",
        'at_most = "3"',
        "23: constraint.end.impact_count.at_most: is 3, but must be a number; its unit has a key of its own",
    ),
    "unknown key of a constraint": (
        "at_most = 3",
        "at_mots = 3",
        "23: constraint.end.impact_count.at_mots: is not known. Did you mean at_most?",
    ),
    "no count": (
        "count = 100\n",
        "",
        "4: optimise.count: is missing; write how many designs may be run, as in count = 200",
    ),
    "method for others": (
        "[vary.restitution]\nfrom = 0\nto = 0.5",
        "[vary.gear]\nvalues = [1, 2]\n[optimise.x]",
        "15: optimise.x: is not known. There are: minimise, maximise, method, count, seed, gradient",
    ),
    "gradients without a variable for them": (
        GOOD[GOOD.index("count = 100") : GOOD.index("\n\n[constraint")],
        "count = 100\ngradient = true\n\n[vary.tooth_count]\nfrom = 10\nto = 25",
        "7: optimise.gradient: is for Real variables with from and to, of which there is none",
    ),
    "gradient as a text": (
        "count = 100",
        'count = 100\ngradient = "yes"',
        "7: optimise.gradient: is 'yes', but must be true or false",
    ),
    "sobol points that are not balanced": (
        "count = 64",
        "count = 60",
        "26: sensitivity.count: is 60, but must be a power of 2, for which alone Sobol points are balanced",
    ),
    "too wide a neighbourhood": (
        "count = 64",
        "count = 64\nwidth = 2",
        "27: sensitivity.width: is 2, but must be a number above 0, up to 1: a part of each variable's range",
    ),
    "sensitivity of one variable": (
        "[vary.restitution]\nfrom = 0\nto = 0.5",
        "",
        "23: sensitivity: compares variables with from and to, of which there must be two or more",
    ),
    "steps": (
        "to = 0.5",
        "to = 0.5\nsteps = 3",
        '16: vary.restitution.steps: goes with a grid only: [sweep] method = "grid"',
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_told_with_its_line(name: str, tmp_path: Path) -> None:
    old, new, told = MISTAKES[name]
    assert old in GOOD
    with pytest.raises(UsageError) as error:
        read(tmp_path, GOOD.replace(old, new))
    lines = [line.strip(" .") for line in str(error.value).replace(f"{tmp_path}/best.toml:", "").splitlines()]
    assert told in lines


def test_a_method_for_real_variables_only_says_so(tmp_path: Path) -> None:
    text = GOOD.replace("count = 100", 'count = 100\nmethod = "differential_evolution"')
    assert read(tmp_path, text).method == CONTINUOUS
    with pytest.raises(UsageError, match="'differential_evolution' is for Real variables with from and to"):
        read(tmp_path, text.replace("[vary.restitution]\nfrom = 0\nto = 0.5", "[vary.gear]\nfrom = 1\nto = 5"))
