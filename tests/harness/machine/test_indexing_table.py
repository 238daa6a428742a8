"""The machine of models/machines/indexing_table.toml: start-up, indexing, and a jam."""

import math
import re
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

import models
from harness.app.cli import main
from harness.app.commands.machine_ready import prepared
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.simulation import Simulation
from tests.harness.machine.one_mechanism import Join, one_mechanism

pytestmark = pytest.mark.slow

MACHINES = Path(__file__).parents[3] / "models" / "machines"
#: Their models.
COMPONENTS = {
    "motor": "motor",
    "gears": "gear_train",
    "cam": "cam_drive",
    "ratchet": "ratchet",
    "table": "rotary_table",
}
TOOTH = math.radians(18)
#: How well the coupling places the pawl's tip [m].
PLACE = 1e-6
#: Cam at 15 rpm: one stroke in 4 s; the motor turns 15 times as fast, the other way round.
MOTOR = -225 * math.pi / 30


def run(
    built: Callable[..., Path],
    folder: Path,
    table: str = "",
    pythonfmu: Iterable[str] = (),
    stop: str = "16.5 s",
    *,
    backwards: bool = False,
) -> pd.DataFrame:
    """The results of the machine, with a table of inputs if one is named; columns without units."""
    file = written(built, folder, table, pythonfmu, stop, backwards=backwards)
    outcome = CliRunner().invoke(main, ["machine", "run", str(file), "-o", str(folder / "result")])
    assert outcome.exit_code == 0, outcome.output
    assert "Warning" not in outcome.output
    found = pd.read_parquet(folder / "result" / "results.parquet")
    return found.rename(columns=lambda name: name.partition(" [")[0]).set_index("time")


def written(
    built: Callable[..., Path],
    folder: Path,
    table: str = "",
    pythonfmu: Iterable[str] = (),
    stop: str = "16.5 s",
    *,
    backwards: bool = False,
) -> Path:
    """The file of the machine, of FMUs that were built before: by pythonfmu where it is said, else native ones.

    `backwards` they stand in the file the other way round.
    """
    folder.mkdir(exist_ok=True)
    file = folder / "machine.toml"
    text = (MACHINES / "indexing_table.toml").read_text(encoding="utf-8").replace("16.5 s", stop)
    if backwards:
        _, *blocks = re.split(r"(?=^\[component\.\w+\]$)", text.partition("# Angles and speeds")[0], flags=re.MULTILINE)
        text = text.replace("".join(blocks), "".join(reversed(blocks)))
    for name, model in COMPONENTS.items():
        fmu = built(model, build_fmu if name in pythonfmu else build_native_fmu)
        text = text.replace(f'model = "{model}"', f'file = "{fmu}"')
    file.write_text(text + (f'input = "{table}"\n' if table else ""), encoding="utf-8")
    if table:
        shutil.copy(MACHINES / table, folder)
    return file


def as_one_mechanism(file: Path) -> Simulation:
    """The machine of a file as a single mechanism: what the coupling should come to."""
    with prepared(str(file)) as machine:
        plan = machine.plan
    own = {part.name: models.load(COMPONENTS[part.name]).MODEL for part in plan.components}
    values = {part.name: dict(part.values) for part in plan.components}
    parts, inputs = {}, {}
    for name, model in own.items():
        parameters = {parameter.name for parameter in model.parameters}
        inputs |= {f"{name}_{key}": value for key, value in values[name].items() if key not in parameters}
        parts[name] = model.build(
            model.values(**{key: value for key, value in values[name].items() if key in parameters})
        )
    joins = [
        Join(
            connection.source.removesuffix("_angle"),
            connection.target.replace("drive_angle", "shaft"),
            connection.offset,
        )
        for connection in plan.connections
        if connection.target.endswith("drive_angle")
    ]
    mechanism = one_mechanism(parts, joins, 1e-10)
    starts = {port.name: port.start for port in mechanism.inputs}
    for connection in plan.connections:  # torques back are what the shafts do
        starts[connection.target.replace(".", "_")] = 0.0
    return Simulation(mechanism, inputs=[inputs.get(port.name, starts[port.name]) for port in mechanism.inputs])


@pytest.fixture(scope="module")
def undisturbed(built, tmp_path_factory):
    return run(built, tmp_path_factory.mktemp("indexing"))


@pytest.fixture(scope="module")
def jammed(built, tmp_path_factory):
    return run(built, tmp_path_factory.mktemp("jam"), "indexing_table_jam.csv")


def near(results, time):
    """The row nearest to a time [s]."""
    return results.iloc[abs(results.index - time).argmin()]


def test_the_motor_starts_within_a_second(undisturbed):
    assert near(undisturbed, 0.0)["motor.rotor_speed"] == 0.0
    started = undisturbed.loc[1.0:]["motor.rotor_speed"]
    assert (started / MOTOR - 1.0).abs().max() < 0.02
    assert undisturbed["motor.voltage"].abs().max() < 12.0


def test_each_stroke_is_a_tooth_and_the_brake_holds_between(undisturbed):
    ends = [near(undisturbed, time) for time in (4.0, 8.0, 12.0, 16.0)]
    assert [end["ratchet.clicks"] for end in ends] == [1, 2, 3, 4]
    held = undisturbed.loc[7.0:8.4]["table.table_angle"]
    assert held.max() - held.min() < 1e-3
    assert undisturbed["table.friction_torque"].abs().max() <= 0.2
    assert (undisturbed["cam.contact_gap"] == 0.0).all()


def test_it_is_what_the_same_machine_is_as_one_mechanism(built, undisturbed, tmp_path):
    single = as_one_mechanism(written(built, tmp_path))
    times, angles = [], []
    for end in np.linspace(0.0, 16.0, 1601):
        single.advance(end)
        times += [impact.time for impact in single.impacts_in_step()]
        angles.append(single.read()["table_table_angle"])
    coupled = undisturbed.loc[:16.0]
    assert coupled["ratchet.impact_count"].iloc[-1] == len(times) == 13
    found, end = single.read(), near(undisturbed, 16.0)
    for name in ("motor.rotor_angle", "cam.cam_angle", "ratchet.crank_angle"):
        assert end[name] == pytest.approx(found[name.replace(".", "_")], abs=1e-6)
    for name in ("ratchet.wheel_angle", "table.table_angle"):  # where the brake has caught them
        assert end[name] == pytest.approx(found[name.replace(".", "_")], abs=1e-4)
    felt = coupled["ratchet.impact_time"].unique()[1:]
    assert felt == pytest.approx(times, abs=5e-4)
    # The first stroke begins beside a tooth, and until the fourth, which is one, that is still felt.
    strokes = np.diff(angles[::400])
    assert strokes[-1] == pytest.approx(TOOTH, abs=1e-6)
    ends = [near(undisturbed, time)["table.table_angle"] for time in (0.0, 4.0, 8.0, 12.0, 16.0)]
    assert np.diff(ends) == pytest.approx(strokes, abs=2e-6)


def test_a_jam_lifts_the_roller_once(jammed):
    """Time and speed of its return from steps of 0.1 ms."""
    assert jammed["cam.impact_count"].iloc[-1] == 1
    assert jammed["cam.impact_time"].iloc[-1] == pytest.approx(11.173, abs=2e-3)


def test_a_jam_costs_the_stroke_and_the_next_one_makes_up_for_it(undisturbed, jammed):
    before = jammed.loc[:8.9]
    assert before["table.table_angle"].iloc[-1] == pytest.approx(near(undisturbed, 8.9)["table.table_angle"], abs=1e-3)
    assert near(jammed, 11.0)["ratchet.clicks"] == 2
    assert near(undisturbed, 11.0)["ratchet.clicks"] == 3
    assert jammed["ratchet.contact_force"].max() > 5 * undisturbed["ratchet.contact_force"].max()
    assert near(jammed, 16.0)["ratchet.clicks"] == 4
    assert near(jammed, 16.0)["motor.rotor_speed"] == pytest.approx(MOTOR, rel=2e-3)


def test_the_order_of_the_components_in_the_file_does_not_matter(built, tmp_path):
    """They were once initialized in this order, with zeros from those that were not: the ratchet was struck."""
    one = run(built, tmp_path / "one", stop="0.3 s")
    other = run(built, tmp_path / "other", stop="0.3 s", backwards=True)
    assert list(one) != list(other)
    assert one["ratchet.impact_count"].iloc[-1] == 0
    pd.testing.assert_frame_equal(one, other, check_exact=True, check_like=True)


@pytest.mark.parametrize(
    ("pythonfmu", "near"), [(COMPONENTS, 1e-3), (("ratchet", "motor"), 5e-5)], ids=["all", "mixed"]
)
def test_components_by_pythonfmu_make_the_same_machine(built, undisturbed, tmp_path, pythonfmu, near):
    """They take no slopes of inputs, so theirs are held, at the mean.

    The pawl touches its tooth again while the brake stops the table, at 13 um/s and 1.6 mm/s: when, is as uncertain as
    the place over the closing speed.
    """
    other = run(built, tmp_path, pythonfmu=pythonfmu, stop="3.6 s")
    same = undisturbed.loc[:3.6]
    assert other["ratchet.clicks"].iloc[-1] == same["ratchet.clicks"].iloc[-1] == 1
    for name in ("cam.cam_angle", "ratchet.crank_angle", "ratchet.wheel_angle", "table.table_angle"):
        seen = np.interp(same.index, other.index, other[name])
        assert seen == pytest.approx(same[name].to_numpy(), abs=near)
    felt = other["ratchet.impact_time"].unique()
    for time, speed in same.groupby("ratchet.impact_time")["ratchet.impact_closing_speed"].first().items():
        assert abs(felt - time).min() < near + (PLACE / speed if speed else 0.0)
