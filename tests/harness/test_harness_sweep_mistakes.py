"""Every mistake in the file of a sweep is told with its line."""

from pathlib import Path

import pytest
from sweep_files import GOOD, mistakes

from harness.errors import UsageError
from harness.toml_file import TomlFile

# What is replaced in the good file, by what, and what is said of it.
MISTAKES = {
    "unknown table": (
        "[set]",
        "[sets]",
        "10: sets: is not known. Did you mean set?",
    ),
    "unknown key": ("step = 0.1", "stop = 0.1", "8: run.stop: is not known. Did you mean step or stop_time?"),
    "unknown variable to set": (
        "guided",
        "gided",
        "12: set.gided: Fake has no variable 'gided'. Did you mean guided?",
    ),
    "unknown variable to vary": (
        "[vary.tooth_count]",
        "[vary.teeth_count]",
        "19: vary.teeth_count: Fake has no variable 'teeth_count'. Did you mean tooth_count?",
    ),
    "unknown output": (
        'end = ["wheel_angle"]',
        'end = ["wheel_angel"]',
        "32: record.end: Fake has no input or output 'wheel_angel'. Did you mean wheel_angle?",
    ),
    "unknown field of impacts": (
        'first_impact = ["time"]',
        'first_impact = ["tim"]',
        "34: record.first_impact: an impact has no 'tim'. Did you mean time?",
    ),
    "stress without a tooth": (
        'first_impact = ["time"]',
        'first_impact = ["stress_max"]',
        "34: record.first_impact: Fake gives no 'stress_max': the FMU declares no beam that impacts strike. In its "
        "model, add Model(analysis=(ImpactStress(...),)) and build it again: docs/how-to/stress-in-a-part.md.",
    ),
    "quantity at another time": (
        'end = ["wheel_angle"]',
        'end = ["tooth_pitch"]',
        "32: record.end: 'tooth_pitch' is a variable of causality calculatedParameter, which cannot be had at "
        "the end of the run. Write it at parameter.",
    ),
    "unknown time of a quantity": (
        "first_impact =",
        "first_impacts =",
        "34: record.first_impacts: is not known. Did you mean first_impact or largest_impact or all_impacts?",
    ),
    "output to set": (
        "guided = false",
        "wheel_angle = 1",
        "12: set.wheel_angle: 'wheel_angle' is a variable of causality output and cannot be set; inputs "
        "and parameters can: drive_torque, gear, brake, tooth_slope_angle, tooth_count, guided, restitution, "
        "crank_inertia, oil_temperature, note.",
    ),
    "wrong unit to set": (
        '"2 N.m"',
        '"2 mm"',
        "11: set.drive_torque: drive_torque = '2 mm': unit 'mm' does not measure the same quantity; these "
        "fit: N.m, also with SI prefixes on any symbol (m, k, ...).",
    ),
    "wrong unit to vary": (
        'unit = "deg"',
        'unit = "mm"',
        "26: vary.tooth_slope_angle.unit: unit 'mm' does not measure the same quantity; these fit: rad, deg, "
        "also with SI prefixes on any symbol (m, k, ...).",
    ),
    "unit of what has none": (
        "to = 25",
        'to = 25\nunit = "deg"',
        "22: vary.tooth_count.unit: 'deg': tooth_count has no unit; leave it out",
    ),
    "wrong unit of a time": (
        '"500 ms"',
        '"500 mm"',
        "7: run.stop_time: stop_time = '500 mm': unit 'mm' does not measure the same quantity; these fit: s, "
        "also with SI prefixes on any symbol (m, k, ...).",
    ),
    "bounds reversed": (
        "from = 85\nto = 105",
        "from = 105\nto = 85",
        "24: vary.tooth_slope_angle.from: = 105 is not below to = 85; exchange them, or give different limits",
    ),
    "bound outside": (
        "from = 10",
        "from = 2",
        "20: vary.tooth_count.from: tooth_count = '2' is below its limit; give at least 3.",
    ),
    "bound of a wrong type": (
        "from = 10",
        "from = 10.5",
        "20: vary.tooth_count.from: tooth_count = '10.5' is not a whole number; give one without point or unit.",
    ),
    "bound with its unit": (
        "from = 85",
        'from = "85 deg"',
        "24: vary.tooth_slope_angle.from: is '85 deg', but must be a number; its unit has a key of its own, as "
        'in unit = "deg"',
    ),
    "missing bound": (
        "to = 105\n",
        "",
        "23: vary.tooth_slope_angle.to: is missing; give from and to, or values",
    ),
    "missing count": (
        "count = 8\n",
        "",
        "14: sweep.count: is missing; write how many designs there shall be, as in count = 64",
    ),
    "missing method": (
        'method = "latin_hypercube"\n',
        "",
        '14: sweep.method: is missing; write e.g. method = "latin_hypercube"',
    ),
    "unknown method": (
        '"latin_hypercube"',
        '"latin_hypercub"',
        "15: sweep.method: is 'latin_hypercub', but must be one of grid, random, latin_hypercube, sobol. Did "
        "you mean latin_hypercube?",
    ),
    "wrong type of the count": (
        "count = 8",
        'count = "8"',
        "16: sweep.count: is '8', but must be a whole number, 1 or more",
    ),
    "count of nothing": (
        "count = 8",
        "count = 0",
        "16: sweep.count: is 0, but must be a whole number, 1 or more",
    ),
    "more than anybody waits for": (
        "count = 8",
        "count = 1_000_001",
        "16: sweep.count: is 1000001, but must be 1,000,000 or less",
    ),
    "nothing to record": (
        '[record]\nend = ["wheel_angle"]\nmax = ["wheel_angle", "impact_count"]\nfirst_impact = ["time"]\nparameter = '
        '["tooth_pitch"]',
        "[record]\nend = []",
        '31: record: is empty; write what to keep of each design, as in end = ["wheel_angle"]',
    ),
    "file of an optimum": (
        "[sweep]",
        "[optimise]",
        "14: optimise: belongs to an optimum: mechanism-fmu optimise",
    ),
    "count of true": (
        "count = 8",
        "count = true",
        "16: sweep.count: is true, but must be a whole number, 1 or more",
    ),
    "negative seed": (
        "seed = 1",
        "seed = -1",
        "17: sweep.seed: is -1, but must be a whole number, 0 or more",
    ),
    "wrong type to set": (
        "guided = false",
        'guided = "maybe"',
        "12: set.guided: guided = 'maybe' is not a Boolean; give true or false.",
    ),
    "wrong type of a list": (
        'end = ["wheel_angle"]',
        'end = "wheel_angle"',
        '32: record.end: is \'wheel_angle\', but must be a list of texts, as in ["a", "b"].',
    ),
    "wrong type of a table": (
        "[vary.gear]\nvalues = [1, 3]",
        "[vary]\ngear = 3",
        "29: vary.gear: must be a table [vary.gear], not 3",
    ),
    "twice in a list": (
        'max = ["wheel_angle", ',
        'max = ["wheel_angle", "wheel_angle", ',
        "33: record.max: 'wheel_angle' is there twice; once is enough",
    ),
    "set and varied": (
        "guided = false",
        "tooth_count = 12",
        "19: vary.tooth_count: 'tooth_count' is fixed in [set] and varied here; give it in one place",
    ),
    "values and bounds": (
        "values = [1, 3]",
        "values = [1, 3]\nfrom = 1",
        "29: vary.gear.values: stands beside from, to or steps; give either values, or from and to",
    ),
    "values twice": (
        "values = [1, 3]",
        "values = [1, 1]",
        "29: vary.gear.values: has the same value twice; the same design would run twice",
    ),
    "no list of values": (
        "values = [1, 3]",
        "values = 3",
        "29: vary.gear.values: must be a list, as in values = [10, 15, 20]",
    ),
    "an empty list of values": (
        "values = [1, 3]",
        "values = []",
        "29: vary.gear.values: must be a list, as in values = [10, 15, 20]",
    ),
    "a text among values": (
        "values = [1, 3]",
        'values = [1, "3"]',
        "29: vary.gear.values: has '3', which is a text; its unit has a key of its own",
    ),
    "bounds of a Boolean": (
        "[vary.gear]\nvalues = [1, 3]",
        "[vary.brake]\nfrom = 0\nto = 1",
        "28: vary.brake.values: is missing; brake is Boolean, so its values must be listed",
    ),
    "steps without a grid": (
        "to = 105",
        "to = 105\nsteps = 3",
        '26: vary.tooth_slope_angle.steps: goes with a grid only: [sweep] method = "grid"',
    ),
    "nothing varied": (
        "[vary.",
        "[vare.",
        "vary: the table [vary] is missing; write [vary.NAME] for each variable, with from and to, or values",
    ),
    "no FMU": (
        'file = "Fake.fmu"',
        "",
        '3: fmu.file: either file = "Ratchet.fmu" or model = "ratchet" must be given, and not both',
    ),
    "title of a wrong type": ('title = "Teeth"', "title = 3", "1: title: must be a text in quotes"),
    "stop before start": (
        '"500 ms"',
        "0",
        "7: run.stop_time: The stop time 0 s must be later than the start time 0 s.",
    ),
    "unknown material": (
        "step = 0.1",
        'step = 0.1\nmaterial = "oak"',
        "9: run.material: there is no material 'oak'; there are steel, S355, C45E, 42CrMo4, SAE1015, SAE4142, AISI4340",
    ),
    "damage without a tooth": (
        'first_impact = ["time"]',
        'all_impacts = ["damage"]',
        "34: record.all_impacts: Fake gives no 'damage': the FMU declares no beam that impacts strike. In its "
        "model, add Model(analysis=(ImpactStress(...),)) and build it again: docs/how-to/stress-in-a-part.md.",
    ),
    "no table of inputs": (
        "step = 0.1",
        'step = 0.1\ninput = "torque.csv"',
        "9: run.input: The input file 'torque.csv' cannot be read: [Errno 2] No such file or directory: 'torque.csv'.",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_told_with_its_line(name: str, tmp_path: Path) -> None:
    old, new, told = MISTAKES[name]
    assert GOOD.count(old) >= 1
    heading, *lines = mistakes(tmp_path, GOOD.replace(old, new))
    assert heading.startswith("teeth.toml has ")
    assert any(line.startswith(told.rstrip(".")) for line in lines)


def test_all_mistakes_are_told_at_once_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = GOOD
    for name in (
        "wrong type of a list",
        "unknown variable to vary",
        "bounds reversed",
        "wrong unit to set",
        "missing count",
    ):
        text = text.replace(*MISTAKES[name][:2])
    told = mistakes(tmp_path, text)
    assert told[0] == "teeth.toml has 5 mistakes; nothing was run"
    assert [line.split(": ")[1] for line in told[1:]] == [
        "set.drive_torque",
        "sweep.count",
        "vary.teeth_count",
        "vary.tooth_slope_angle.from",
        "record.end",
    ]


def test_a_count_does_not_go_with_a_grid(tmp_path: Path) -> None:
    lines = mistakes(tmp_path, GOOD.replace('"latin_hypercube"', '"grid"').replace("to = 105", "to = 105\nsteps = 5"))
    assert lines[1:] == [
        f"{line}: sweep.{name}: does not go with a grid, which has every value with every other"
        for line, name in ((16, "count"), (17, "seed"))
    ]


@pytest.mark.parametrize(("text", "told"), [("[fmu", "this is no TOML"), ("unit = deg", "this is no TOML")])
def test_what_is_no_toml(text: str, told: str, tmp_path: Path) -> None:
    assert told in mistakes(tmp_path, text)[0]


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="There is no file"):
        TomlFile.read(tmp_path / "nowhere.toml")


def test_an_input_that_a_table_drives_cannot_be_varied_or_set(tmp_path: Path) -> None:
    (tmp_path / "torque.csv").write_text("time,drive_torque,gear\n0,1,1\n1,2,1\n")
    lines = mistakes(tmp_path, GOOD.replace("step = 0.1", 'step = 0.1\ninput = "torque.csv"'))
    assert lines[1:] == [
        f"{line}: {key}: '{key.split('.')[1]}' is in the table of inputs, too (run.input); give it in one place"
        for line, key in ((12, "set.drive_torque"), (29, "vary.gear"))
    ]


def test_quoted_and_dotted_keys_have_lines_too(tmp_path: Path) -> None:
    text = GOOD.replace("[vary.gear]\nvalues = [1, 3]", '[ vary . "gear" ] # twice\n"values" = [1, 1]')
    assert mistakes(tmp_path, text)[1].startswith("29: vary.gear.values: has the same value twice")


def test_a_wrong_unit_hides_no_reversed_bounds(tmp_path: Path) -> None:
    text = GOOD.replace("from = 85", "from = 115").replace('unit = "deg"', 'unit = "kg"')
    assert [line.split(":")[1].strip() for line in mistakes(tmp_path, text)[1:]] == [
        "vary.tooth_slope_angle.from",
        "vary.tooth_slope_angle.unit",
    ]
