"""A coupled machine against the same machine as one mechanism in the engine.

The ratchet with the paper's numbers strikes once, at 0.94 s, and swings on its spring; its wheel turns another wheel
through a compliant shaft, and that one reaches a stop because of the impact, and bounces there. What the coupling does
late, the second wheel does late.
"""

import math
from contextlib import ExitStack
from functools import partial

import numpy as np
import pytest

from harness.fmu import open_fmu
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import EventAware, GaussSeidel, Jacobi
from harness.run.master import Ending, TimeGrid
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL as RATCHET
from tests.harness.machine import stopped_wheel
from tests.harness.machine.one_mechanism import Join, one_mechanism

EXACT = {"relative_tolerance": 1e-11}
VALUES = {"ratchet": EXACT, "wheel": {"drive_stiffness": 0.3, "drive_damping": 0.01, **EXACT}}
START = math.radians(75)
CONNECTIONS = (
    Connection("ratchet.wheel_angle", "wheel.drive_angle", offset=-START, rate="ratchet.wheel_speed"),
    Connection("ratchet.wheel_speed", "wheel.drive_speed"),
    Connection("wheel.drive_shaft_torque", "ratchet.load_torque", gain=-1.0),
)
SIGNALS = ("ratchet.wheel_angle", "ratchet.wheel_speed", "wheel.wheel_angle", "wheel.wheel_speed")
#: Before the ratchet's impact, and behind several of the wheel's [s].
SMOOTH, STOP = 0.9, 2.25
#: Four steps [s].
STEPS = (10e-3, 5e-3, 2.5e-3, 1.25e-3)


class Impacts:
    """Times of impacts of each part (an `Observer`)."""

    def __init__(self):
        self.times = {"ratchet": [], "wheel": []}

    def started(self, machine, time):
        pass

    def stepped(self, machine, time):
        for part, times in self.times.items():
            (count,) = machine.get([f"{part}.impacts_in_step"])
            times += machine.get([f"{part}.impacts[{k + 1}].time" for k in range(count)])


@pytest.fixture(scope="module")
def single():
    """The machine as one mechanism: its outputs by time, its impact times by part."""
    parts = {
        "ratchet": RATCHET.build(RATCHET.values(**VALUES["ratchet"])),
        "wheel": stopped_wheel.MODEL.build(stopped_wheel.MODEL.values(**VALUES["wheel"])),
    }
    simulation = Simulation(one_mechanism(parts, [Join("ratchet.wheel", "wheel.shaft", -START)]))
    outputs, times = {}, {"ratchet": [], "wheel": []}
    for k in range(1, round(STOP / 0.01) + 1):
        simulation.advance(k * 0.01)
        for impact in simulation.impacts_in_step():
            times[impact.contact.partition("_")[0]].append(impact.time)
        found = simulation.read()
        outputs[k] = [found[name.replace(".", "_")] for name in SIGNALS]
    return {SMOOTH: outputs[round(SMOOTH / 0.01)], STOP: outputs[round(STOP / 0.01)]}, times


@pytest.fixture(scope="module")
def run(native_ratchet_fmu, tmp_path_factory):
    """A function that runs the machine of two FMUs, and gives the signals at its end and the impact times."""
    folder = tmp_path_factory.mktemp("stopped_wheel")
    build_native_fmu(stopped_wheel, folder)
    files = {"ratchet": native_ratchet_fmu, "wheel": next(folder.glob("*.fmu"))}
    values = {f"{part}.{name}": value for part, own in VALUES.items() for name, value in own.items()}
    with ExitStack() as stack:
        fmus = {part: stack.enter_context(open_fmu(path)) for part, path in files.items()}

        def machine_run(algorithm, extrapolation, step, stop=STOP):
            with ExitStack() as instances:
                parts = {part: instances.enter_context(fmu.instantiate(part)) for part, fmu in fmus.items()}
                machine = Machine(parts, CONNECTIONS, extrapolation)
                impacts = Impacts()
                outcome = run_machine(machine, algorithm(machine), TimeGrid.of(stop, step), values, [impacts])
                assert outcome.ending is Ending.COMPLETED, outcome.error
                return machine.get(SIGNALS), impacts.times

        yield machine_run


def jacobi(_machine):
    return Jacobi()


def gauss_seidel(_machine):
    return GaussSeidel()


def slope(errors):
    """The measured order of errors, shape (steps, numbers): how steep their norm is over the step, in logarithms."""
    return np.polyfit(np.log(STEPS), np.log(np.linalg.norm(errors, axis=1)), 1)[0]


@pytest.mark.parametrize(
    ("algorithm", "extrapolation", "order"),
    [
        (jacobi, "constant", 1.0),
        (gauss_seidel, "constant", 1.0),
        (jacobi, "linear", 2.0),
        (jacobi, "derivatives", 2.0),
        (gauss_seidel, "linear", 2.0),
        (EventAware, "constant", 1.0),
        (EventAware, "derivatives", 2.0),
    ],
)
def test_order_where_the_motion_is_smooth(single, run, algorithm, extrapolation, order):
    exact = single[0][SMOOTH]
    errors = [np.abs(np.subtract(run(algorithm, Extrapolation(extrapolation), h, SMOOTH)[0], exact)) for h in STEPS]
    assert slope(errors) == pytest.approx(order, abs=0.15), errors


@pytest.mark.parametrize(("algorithm", "order"), [(jacobi, 0.8), (EventAware, 2.5)])
def test_order_behind_impacts(single, run, algorithm, order):
    """Fixed steps let a neighbour feel an impact late, by up to a step, whatever is known of the motion between."""
    exact = single[1]["wheel"][:3]
    times = [run(algorithm, Extrapolation.DERIVATIVES, h)[1]["wheel"][:3] for h in STEPS]
    assert slope(np.abs(np.subtract(times, exact))) == pytest.approx(order, abs=0.25)


def test_impacts_of_a_neighbour_at_steps_of_5_ms(single, run):
    exact = single[1]["wheel"][:3]
    off = partial(np.subtract, exact)
    _, fixed = run(jacobi, Extrapolation.CONSTANT, 5e-3)
    _, aware = run(EventAware, Extrapolation.DERIVATIVES, 5e-3)
    assert len(aware["ratchet"]) == len(fixed["ratchet"]) == 1
    assert aware["ratchet"][0] == pytest.approx(single[1]["ratchet"][0], abs=1e-7)
    assert np.min(np.abs(off(fixed["wheel"][:3]))) > 1.5e-3  # milliseconds
    assert np.max(np.abs(off(aware["wheel"][:3]))) < 1e-6
