"""A machine's file: what it says, and all that can be wrong with it, at once."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from harness.errors import UsageError
from harness.fmu.description import Description, Variable
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import Plan, Scheme, Source
from harness.machine.file.notes import notes
from harness.machine.file.read_file import components, read_plan
from harness.machine.file.write_file import machine_toml
from harness.machine.part import Extrapolation
from harness.toml_file import TomlFile
from tests.harness.fake_slave import UNITS

RUN = '[run]\nstop_time = "2 s"\nstep = "5 ms"\n'
PARTS = '[component.motor]\nmodel = "motor"\n[component.table]\nmodel = "table"\n'
CONNECT = '[[connect]]\nfrom = "motor.speed"\nto = "table.speed"\n'
BACK = '[[connect]]\nfrom = "table.torque"\nto = "motor.load"\ngain = -1\n'


def description(model: str, *variables: Variable, **abilities: bool) -> Description:
    return Description(model, model, "{guid}", {v.name: v for v in variables}, UNITS, **abilities)


def real(name: str, causality: str, unit: str, **more: object) -> Variable:
    return Variable(name, 0, "Real", causality, unit=unit, continuous=True, **more)  # type: ignore[arg-type]


MOTOR = description(
    "Motor",
    real("speed", "output", "rad/s", depends_on=frozenset()),
    real("acceleration", "output", "rad/s/s"),
    real("load", "input", "N.m", start="0"),
    real("voltage", "input", "", start="24"),
    real("inertia", "parameter", "kg.m2", start="1e-4", minimum=0.0),
    saves_state=True,
    gives_slopes=True,
    takes_slopes=True,
)
TABLE = description(
    "Table",
    real("speed", "input", "rad/s", start="0"),
    real("torque", "output", "N.m"),
    real("angle", "output", "rad"),
    Variable("teeth", 5, "Integer", "parameter", start="10", minimum=3.0),
    Variable("brake", 6, "Boolean", "input", start="false"),
)
DESCRIPTIONS = {"motor": MOTOR, "table": TABLE}


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., Plan]:
    def read(text: str, descriptions: Mapping[str, Description] = DESCRIPTIONS) -> Plan:
        path = tmp_path / "machine.toml"
        path.write_text(text, encoding="utf-8")
        file = TomlFile.read(path)
        return read_plan(file, components(file, ["motor", "table"]), descriptions)

    return read


@pytest.fixture
def mistakes(read: Callable[..., Plan]) -> Callable[..., list[str]]:
    """The lines of the message about a file, without the path."""

    def mistakes(text: str, descriptions: Mapping[str, Description] = DESCRIPTIONS) -> list[str]:
        with pytest.raises(UsageError) as error:
            read(text, descriptions)
        return [line.rpartition("machine.toml:")[2] for line in str(error.value).splitlines()[1:]]

    return mistakes


def test_a_whole_file(read, tmp_path):
    plan = read(
        'title = "Table"\n'
        '[run]\nstop_time = "2000 ms"\nstep = 5e-3\nalgorithm = "jacobi"\nextrapolation = "linear"\n'
        'material = "42CrMo4"\ninput = "drive.csv"\n'
        '[component.motor]\nmodel = "motor"\nflavour = "pythonfmu"\nprocess = true\ntime_limit = "500 ms"\n'
        '[component.motor.set]\ninertia = "1 g.m2"\n'
        '[component.table]\nmodel = "table"\nfmi = 3\n[component.table.set]\nteeth = 12\nbrake = true\n'
        '[[connect]]\nfrom = "motor.speed"\nto = "table.speed"\noffset = "60 rpm"\nrate = "motor.acceleration"\n'
        f"{BACK}"
        '[[bond]]\nname = "shaft"\nflow = "table.speed"\neffort = "motor.load"\n'
        '[record]\nsignals = ["motor.*"]\nevery = 10\nformat = "csv"\n'
        if (tmp_path / "drive.csv").write_text("time [s],motor.voltage\n0,0\n2,24\n")
        else ""
    )
    assert (plan.title, plan.material) == ("Table", "42CrMo4")
    policy = plan.policy
    assert (policy.stop_time, policy.step) == (2.0, 0.005)
    assert (policy.scheme, policy.extrapolation) == (Scheme.JACOBI, Extrapolation.LINEAR)
    motor, table = plan.components
    assert motor.source == Source(None, "motor", "pythonfmu", 2)
    assert (motor.process, motor.time_limit) == (True, 0.5)
    assert motor.values == {"inertia": pytest.approx(1e-3, rel=1e-15)}
    assert table.source == Source(None, "table", "native", 3)
    assert plan.start_values.keys() == {"motor.inertia", "table.teeth", "table.brake"}
    flow, effort = plan.connections
    assert flow.offset == pytest.approx(2 * math.pi)
    assert flow.rate == "motor.acceleration"
    assert effort == Connection("table.torque", "motor.load", -1.0)
    assert (plan.bonds[0].name, plan.bonds[0].flow, plan.bonds[0].effort) == ("shaft", flow, effort)
    assert (plan.recording.signals, plan.recording.every, plan.recording.format) == (("motor.*",), 10, "csv")
    assert plan.inputs == tmp_path / "drive.csv"


def test_what_need_not_be_said(read):
    plan = read(RUN + PARTS)
    assert plan.title == "machine"
    assert (plan.policy.scheme, plan.policy.extrapolation) == (Scheme.EVENT_AWARE, Extrapolation.DERIVATIVES)
    assert plan.connections == plan.bonds == ()
    assert plan.recording.signals == ("*",)
    assert plan.components[0].source.flavour == "native"


def test_all_mistakes_at_once_with_their_lines(mistakes):
    found = mistakes(
        '[run]\nstop_time = "2 kg"\nstep = "5 ms"\nalgorithm = "jakobi"\n'
        f"{PARTS}"
        "[component.motor.set]\ninertai = 1\n"
        "[component.table.set]\nteeth = 2\n"
        '[[connect]]\nfrom = "motor.speeed"\nto = "table.speed"\n'
        '[[connect]]\nfrom = "motor.speed"\nto = "tabel.speed"\n'
        '[[connect]]\nfrom = "table.torque"\nto = "table.speed"\n'
        '[record]\nsignals = ["motor.spede"]\n'
        "[plot]\n"
    )
    lines = [int(text.partition(":")[0]) for text in found]
    assert lines == sorted(lines) == [2, 4, 10, 12, 14, 18, 20, 21, 23, 24]
    by_line = dict(zip(lines, found, strict=True))
    assert "run.stop_time" in by_line[2]
    assert "s" in by_line[2]
    assert "Did you mean jacobi?" in by_line[4]
    assert "Did you mean inertia?" in by_line[10]
    assert "at least 3" in by_line[12]
    assert "connect[1].from: motor has no variable 'speeed'. Did you mean speed?" in by_line[14]
    assert "connect[2].to: 'tabel.speed' is none of <component>.<variable>; components: motor, table" in by_line[18]
    assert "does not measure the same quantity" in by_line[20]
    assert "connect[3].to: 'table.speed' has a connection already, connect[1]" in by_line[21]
    assert "record.signals: 'motor.spede' is no variable" in by_line[23]
    assert "plot: is not known" in by_line[24]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (RUN, "component: the table [component] is missing"),
        (PARTS, "run: the table [run] is missing"),
        (RUN + "[component]\n", "component: is empty"),
        (RUN + '[component."my motor"]\nmodel = "motor"\n', "is no name for a component"),
        (RUN + "[component.motor]\n", "component.motor.file: either file = "),
        (RUN + '[component.motor]\nmodel = "motro"\n', "there is no model 'motro'. Did you mean motor?"),
        (RUN + '[component.motor]\nfile = "nowhere.fmu"\n', "there is no FMU file"),
        (RUN + '[component.motor]\nmodel = "mine.py"\n', "there is no file"),
        (RUN + '[component.motor]\nmodel = "motor"\nfmi = 3\nflavour = "pythonfmu"\n', "native flavour only"),
        (RUN + PARTS + "time_limit = 3\n", "time_limit: needs process = true"),
        (RUN + PARTS + 'process = true\ntime_limit = "0 s"\n', "must be above 0"),
        (RUN + PARTS + CONNECT + CONNECT, "connect[2].to: 'table.speed' has a connection already"),
        (RUN + PARTS + CONNECT + "gain = 0\n", "a gain that is not 0"),
        (RUN + PARTS + CONNECT + 'gain = "2"\n', "must be a number"),
        (RUN + PARTS + CONNECT + 'offset = "2 m"\n', "does not measure the same quantity"),
        (RUN + PARTS + CONNECT + 'rate = "motor.speed"\n', "does not measure the same as rad/s/s"),
        (RUN + PARTS + '[[connect]]\nfrom = "motor.inertia"\nto = "table.speed"\n', "the source is no output"),
        (RUN + PARTS + '[connect]\nfrom = "motor.speed"\n', "each below a line [[connect]]"),
        (RUN + PARTS + CONNECT + "[component.table.set]\nspeed = 1\n", "follows motor.speed, by a connection"),
        (RUN + PARTS + CONNECT + '[[bond]]\nflow = "table.speed"\neffort = "motor.load"\n', "no connected input"),
        (
            RUN + PARTS + CONNECT + BACK + '[[bond]]\nflow = "table.speed"\neffort = "table.speed"\n',
            "does not go back between the components",
        ),
        (RUN + "tolerance = 1e-3\n" + PARTS, 'goes with algorithm = "adaptive" only'),
        (RUN + 'algorithm = "adaptive"\ntolerance = 2\n' + PARTS, "must be above 0 and below 1"),
        (RUN + 'algorithm = "adaptive"\n' + PARTS, "but table cannot; take jacobi"),
        (RUN + 'material = "cheese"\n' + PARTS, "cheese"),
        (RUN + 'input = "nowhere.csv"\n' + PARTS, "cannot be read"),
        (RUN.replace("5 ms", "-5 ms") + PARTS, "run.step: step = '-5 ms' is below its limit; give at least 0 s"),
        (RUN.replace("2 s", "0 s") + PARTS, "must be later than the start time"),
    ],
)
def test_mistakes(mistakes, text, said):
    assert any(said in line for line in mistakes(text)), mistakes(text)


@pytest.mark.parametrize(
    ("run", "said"),
    [
        ("", "run.algorithm: = 'event_aware' takes steps of different sizes, which table cannot"),
        ('algorithm = "adaptive"\n', 'take algorithm = "jacobi" or "gauss_seidel"'),
        ('algorithm = "jacobi"\n', None),
        ('algorithm = "jacobi"\nstop_time = 2.002\n', "is no multiple of the step, so that the last step is shorter"),
    ],
)
def test_components_whose_steps_have_one_size(read, mistakes, run, said):
    fixed = {"motor": MOTOR, "table": replace(TABLE, varies_step=False)}
    text = (RUN.replace('stop_time = "2 s"\n', "") if "stop_time" in run else RUN) + run + PARTS
    if said is None:
        read(text, fixed)
    else:
        assert any(said in line for line in mistakes(text, fixed)), mistakes(text, fixed)


def test_fmus_of_which_a_process_can_have_one_only(read, mistakes):
    once = replace(TABLE, once_per_process=True)
    text = f'{RUN}{PARTS}[component.other]\nmodel = "table"\n'
    descriptions = {"motor": MOTOR, "table": once, "other": once}
    assert any("component.other: is the same FMU as table" in line for line in mistakes(text, descriptions))
    read(f"{text}process = true\n", descriptions)
    read(text, {"motor": MOTOR, "table": TABLE, "other": TABLE})


def test_what_is_not_there_yet_is_not_checked_but_the_rest_is(mistakes):
    text = RUN + PARTS.replace('"motor"', '"motro"') + CONNECT.replace("table.speed", "table.spede")
    found = mistakes(text, {"table": TABLE})
    assert len(found) == 2
    assert "there is no model 'motro'" in found[0]
    assert "table has no variable 'spede'" in found[1]


def test_an_input_is_set_in_one_place(mistakes, tmp_path):
    (tmp_path / "drive.csv").write_text("time [s],motor.voltage\n0,0\n2,24\n")
    text = RUN + 'input = "drive.csv"\n' + PARTS + "[component.motor.set]\nvoltage = 12\n"
    assert any("is in the table of inputs, too" in line for line in mistakes(text))


def test_a_table_drives_no_input_that_follows_somebody(mistakes, tmp_path):
    (tmp_path / "drive.csv").write_text("time [s],table.speed\n0,0\n2,24\n")
    text = RUN + 'input = "drive.csv"\n' + PARTS + CONNECT
    assert any("'table.speed' follows motor.speed, by a connection" in line for line in mistakes(text))


def test_components_must_mean_the_same_by_a_unit_where_they_are_connected(read, mistakes):
    other = Description("Table", "Table", "", dict(TABLE.variables), type(UNITS)({"N.m": UNITS.defined["m"]}))
    descriptions = {"motor": MOTOR, "table": other}
    assert read(RUN + PARTS + CONNECT, descriptions).connections
    assert any("as table defines it" in line for line in mistakes(RUN + PARTS + BACK, descriptions))


def test_what_has_no_unit_is_told(read):
    bare = Description("Table", "Table", "", {v.name: replace(v, unit="") for v in TABLE.variables.values()}, UNITS)
    found = notes(read(RUN + PARTS + CONNECT + BACK, {"motor": MOTOR, "table": bare}), {"motor": MOTOR, "table": bare})
    said = "No unit is known of table.speed (rad/s, as motor.speed), table.torque (N.m, as motor.load): "
    assert f"{said}that of what it goes with was taken." in found


def test_notes(read):
    plan = read(RUN + PARTS + CONNECT + BACK)
    said = " ".join(notes(plan, DESCRIPTIONS))
    assert "motor, table follow each other: a cycle." in said
    assert "Inputs of motor that follow nobody and are not set keep their start values: voltage = 24." in said
    assert "brake = false" in said
    assert "table takes no slopes of inputs" in said
    assert "No derivative is known of table.torque" in said
    assert "table cannot be put back" in said
    assert "loop" not in said


#: As long as the motor is on, the table is braked and has a drag.
SWITCHED = """
[[connect]]
from = "motor.on"
to = "table.brake"
[[connect]]
from = "motor.on"
to = "table.drag"
gain = 2.5
{convert}
"""
_ON = Variable("on", 7, "Boolean", "output", depends_on=frozenset())
KINDS = {
    "motor": replace(MOTOR, variables=MOTOR.variables | {"on": _ON}),
    "table": replace(TABLE, variables=TABLE.variables | {"drag": real("drag", "input", "N.m")}),
}


def test_signals_that_are_held_are_noted_and_no_derivative_of_them_is_missed(read, tmp_path):
    plan = read(RUN + PARTS + SWITCHED.format(convert="convert = true"), KINDS)
    assert plan.connections[1] == Connection("motor.on", "table.drag", 2.5, convert=True)
    said = " ".join(notes(plan, KINDS))
    assert "Held, and never interpolated or extrapolated: motor.on -> table.brake, motor.on -> table.drag." in said
    assert "derivative" not in said
    assert "No unit is known" not in said
    assert read(machine_toml(plan, KINDS, tmp_path), KINDS) == plan


def test_a_conversion_must_be_asked_for(read):
    with pytest.raises(
        UsageError, match=r"connection motor.on -> table.drag: Boolean to Real \(false = 0, true = 1\); say"
    ):
        read(RUN + PARTS + SWITCHED.format(convert=""), KINDS)


def test_a_loop_without_delay_is_noted(read):
    motor = replace(MOTOR, variables=MOTOR.variables | {"speed": real("speed", "output", "rad/s")})
    said = notes(read(RUN + PARTS + CONNECT + BACK), DESCRIPTIONS | {"motor": motor})
    assert any("table.speed, motor.load follow each other at once" in line for line in said)


@pytest.mark.parametrize(
    ("gain", "reaction", "said"),
    [
        (-1, "false", None),
        (1, "true", None),
        (1, "false", "motor is pushed on by what it drives, if that output is the torque or force on table."),
        (-2, "true", "Perhaps the gain should be 2."),
    ],
)
def test_a_driver_that_is_pushed_by_what_it_drives(read, gain, reaction, said):
    bond = f'[[bond]]\nflow = "table.speed"\neffort = "motor.load"\nreaction = {reaction}\n'
    found = notes(read(RUN + PARTS + CONNECT + BACK.replace("-1", str(gain)) + bond), DESCRIPTIONS)
    told = [note for note in found if note.startswith("Bond")]
    assert len(told) == (said is not None)
    assert said is None or said in told[0]


def test_no_notes_where_there_is_nothing_to_say(read):
    text = RUN.replace('"5 ms"\n', '"5 ms"\nalgorithm = "jacobi"\nextrapolation = "constant"\n')
    plan = read(text + PARTS + CONNECT + "[component.table.set]\nbrake = true\n[component.motor.set]\nvoltage = 0\n")
    assert notes(plan, DESCRIPTIONS, ["motor.load"]) == []


def test_what_is_written_is_read_as_the_same(read, tmp_path):
    plan = read(
        RUN + 'algorithm = "jacobi"\n' + PARTS + 'process = true\ntime_limit = "3 s"\n'
        "[component.motor.set]\ninertia = 0.1234567890123456789\n"
        f'{CONNECT}gain = 0.1\noffset = "1 rpm"\nrate = "motor.acceleration"\n{BACK}'
        '[[bond]]\nname = "a \\"shaft\\""\nflow = "table.speed"\neffort = "motor.load"\n'
        "reaction = true\n[record]\nevery = 3\n"
    )
    assert read(machine_toml(plan, DESCRIPTIONS, tmp_path, ["A note."])) == plan
