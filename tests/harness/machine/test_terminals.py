"""Shafts as terminals: three connections at once, with the sign of the torque, and what cannot be one."""

import re
from pathlib import Path

import pytest

import models
from harness.errors import UsageError
from harness.fmu.description_file import read_description
from harness.fmu.terminals import FILE, Member, read_terminals
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import Plan
from mechanism_fmu.fmu.disk.archive import read_entries, write_archive
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.model.baked import Baked, Seen
from tests.harness.machine.machines import BACK, geared_cam, plan_of

_MEMBERS = """<TerminalMemberVariable variableName="{angle}" memberName="angle" variableKind="signal"/>
<TerminalMemberVariable variableName="{speed}" memberName="speed" variableKind="signal"/>
<TerminalMemberVariable variableName="{torque}" memberName="torque" variableKind="inflow"/>"""

_CAM = _MEMBERS.format(angle="drive_angle", speed="drive_speed", torque="drive_shaft_torque")
_WHEEL = _MEMBERS.format(angle="wheel_angle", speed="wheel_speed", torque="load_torque")

_PLUGGED = """
[[connect]]
from = "{first}"
to = "{second}"
{more}
[[bond]]
name = "shaft"
flow = "cam.drive_speed"
effort = "gears.load_torque"
"""


def with_terminal(fmu: Path, folder: Path, members: str, name: str = "shaft", rule: str = "plug") -> Path:
    """A copy of an FMU with a terminal."""
    text = (
        '<fmiTerminalsAndIcons fmiVersion="3.0"><Terminals>'
        f'<Terminal name="{name}" matchingRule="{rule}" terminalKind="mechanism_fmu.shaft" description="A shaft">'
        f"{members}</Terminal></Terminals></fmiTerminalsAndIcons>"
    )
    path = folder / fmu.name
    write_archive({**read_entries(fmu), FILE: text.encode()}, path)
    return path


@pytest.fixture(scope="module")
def fmus(tmp_path_factory, native_gear_train_fmu, native_cam_drive_fmu) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("terminals")
    gears = with_terminal(native_gear_train_fmu, folder, _WHEEL, "wheel_shaft")
    return gears, with_terminal(native_cam_drive_fmu, folder, _CAM)


def plan_with(folder: Path, fmus: tuple[Path, Path], connect: str) -> Plan:
    """The machine of `geared_cam`, with other connections."""
    path = geared_cam(folder, *fmus, "")
    text = path.read_text()
    before, _, rest = text.partition("[[connect]]")
    path.write_text(before + connect + "[record]" + rest.partition("[record]")[2])
    return plan_of(path)


def test_they_are_read(fmus: tuple[Path, Path]) -> None:
    found = read_description(fmus[1]).terminals["shaft"]
    assert (found.rule, found.kind) == ("plug", "mechanism_fmu.shaft")
    assert found.members[2] == Member("torque", "drive_shaft_torque", "inflow")


def test_an_fmu_without_the_file_has_none(native_slider_crank_fmu: Path, tmp_path: Path) -> None:
    bare = {name: data for name, data in read_entries(native_slider_crank_fmu).items() if name != FILE}
    write_archive(bare, tmp_path / "bare.fmu")
    assert read_terminals(tmp_path / "bare.fmu") == {}


@pytest.mark.parametrize("ends", [("gears.wheel_shaft", "cam.shaft"), ("cam.shaft", "gears.wheel_shaft")])
def test_three_connections_whichever_way_round(fmus: tuple[Path, Path], tmp_path: Path, ends: tuple[str, str]) -> None:
    """What the machine's own example says one by one."""
    given = _PLUGGED.format(first=ends[0], second=ends[1], more="")
    plan = plan_with(tmp_path, fmus, given)
    assert set(plan.connections) == {
        Connection("gears.wheel_angle", "cam.drive_angle", rate="gears.wheel_speed"),
        Connection("gears.wheel_speed", "cam.drive_speed"),
        Connection("cam.drive_shaft_torque", "gears.load_torque", gain=-1.0),
    }
    assert [bond.name for bond in plan.bonds] == ["shaft"]
    by_hand = plan_of(geared_cam(tmp_path, *fmus, BACK.replace('offset = "1 N.mm"\n', "")))
    assert set(by_hand.connections) == set(plan.connections)


def test_the_models_bring_terminals_of_their_own(native_gear_train_fmu, native_cam_drive_fmu, tmp_path: Path) -> None:
    """As the page about machines connects them."""
    given = _PLUGGED.format(first="gears.wheel_shaft", second="cam.drive_shaft", more="")
    plan = plan_with(tmp_path, (native_gear_train_fmu, native_cam_drive_fmu), given)
    by_hand = geared_cam(tmp_path, native_gear_train_fmu, native_cam_drive_fmu, BACK.replace('offset = "1 N.mm"\n', ""))
    assert set(plan.connections) == set(plan_of(by_hand).connections)


def test_a_baked_copy_has_no_terminal_of_a_shaft_that_it_is_given_otherwise(tmp_path: Path) -> None:
    """Its angle is shifted, so no plug fits; the cam's own shaft, which nothing is baked into, stays."""
    path = build_native_fmu(models.load("cam_drive"), tmp_path, baked=Baked({}, {"drive_angle": Seen(1.0, 0.5)}))
    plain = build_native_fmu(models.load("cam_drive"), tmp_path / "plain")
    assert read_terminals(plain).keys() - read_terminals(path).keys() == {"drive_shaft"}
    assert read_terminals(path)


def test_an_offset_is_of_the_angle(fmus: tuple[Path, Path], tmp_path: Path) -> None:
    given = _PLUGGED.format(first="gears.wheel_shaft", second="cam.shaft", more='offset = "180 deg"')
    offsets = {c.target: c.offset for c in plan_with(tmp_path, fmus, given).connections}
    assert offsets == {"cam.drive_angle": pytest.approx(3.14159265), "cam.drive_speed": 0.0, "gears.load_torque": 0.0}


@pytest.mark.parametrize(
    ("members", "rule", "connect", "said"),
    [
        (_CAM, "bus", "", "is matched by the rule 'bus'"),
        (_CAM.splitlines()[0], "plug", "", "has the members angle, speed, torque, and 'cam.shaft' has angle"),
        (_CAM.replace("drive_angle", "cam_angle"), "plug", "", "one must be an output and the other an input"),
        (_CAM.replace("drive_angle", "no_angle"), "plug", "", "'cam.no_angle', which the FMU does not have"),
        (_CAM.replace("inflow", "signal"), "plug", "", "the member torque is of kind inflow there, and signal here"),
        (_CAM, "plug", "gain = 2", "connect[1].gain: goes with a connection of variables"),
        (_CAM, "plug", 'offset = "1 m"', "does not measure the same quantity"),
    ],
)
def test_what_does_not_fit(
    fmus: tuple[Path, Path], tmp_path: Path, members: str, rule: str, connect: str, said: str
) -> None:
    strange = with_terminal(fmus[1], tmp_path, members, rule=rule)
    given = _PLUGGED.format(first="gears.wheel_shaft", second="cam.shaft", more=connect).partition("[[bond]]")[0]
    with pytest.raises(UsageError, match=re.escape(said)):
        plan_with(tmp_path, (fmus[0], strange), given)


def test_a_terminal_and_a_variable(fmus: tuple[Path, Path], tmp_path: Path) -> None:
    given = '[[connect]]\nfrom = "gears.wheel_shaft"\nto = "cam.drive_angle"\n'
    with pytest.raises(UsageError, match=r"'cam.drive_angle' is no terminal, .* there are: gears.wheel_shaft"):
        plan_with(tmp_path, fmus, given)


def test_a_damaged_file_is_told(native_cam_drive_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "damaged.fmu"
    write_archive({**read_entries(native_cam_drive_fmu), FILE: b"<a"}, path)
    with pytest.raises(UsageError, match=r"its terminalsAndIcons/terminalsAndIcons.xml is no XML"):
        read_description(path)
