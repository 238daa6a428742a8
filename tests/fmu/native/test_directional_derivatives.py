"""Directional and adjoint derivatives of native FMUs, beside difference quotients of the FMUs themselves."""

import itertools
import re
import zipfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

import models
from harness.fmu import open_fmu
from harness.fmu.instances.common import FmuSlave
from harness.fmu.instances.integration import Integrator
from mechanism_fmu.fmu.native.package import build_native_fmu

#: Times [s] at which the modes of contacts and friction are others, or the default: a third of the experiment.
TIMES = {"ratchet": (0.5, 1.5), "rotary_table": (0.05, 1.0), "slider_crank": (0.1, 0.6)}


@pytest.fixture
def instance() -> Iterator[Callable[..., FmuSlave]]:
    """A function that makes an initialized instance of an FMU."""
    with ExitStack() as stack:

        def make(path: Path, integrator: Integrator | None = None) -> FmuSlave:
            slave = stack.enter_context(stack.enter_context(open_fmu(path, integrator)).instantiate("one"))
            slave.initialize(0.0, 10.0)
            return slave

        yield make


def inputs_and_outputs(slave: FmuSlave) -> tuple[list[str], list[str]]:
    known = [v.name for v in slave.description.of("input") if v.type == "Real"]
    return known, [v.name for v in slave.description.of("output") if v.continuous]


def derivative(slave: FmuSlave, unknown: list[str], known: list[str], seed: list[float]) -> np.ndarray:
    references = [[slave.description.variables[name].reference for name in names] for names in (unknown, known)]
    return np.array(slave._instance.getDirectionalDerivative(*references, seed))


def quotient(slave: FmuSlave, outputs: list[str], name: str) -> np.ndarray:
    """By differences of sixth order, whose step is the best one: the least change from one step to the next."""
    at = slave.get([name])[0]

    def difference(step: float) -> np.ndarray:
        ends = []
        for sign in (1.0, -1.0):
            slave.set({name: at + sign * step})
            ends.append(np.array(slave.get(outputs), float))
        slave.set({name: at})
        return (ends[0] - ends[1]) / (2.0 * step)

    second = [difference(2.0**-k) for k in range(3, 25)]
    fourth = [(4.0 * finer - coarse) / 3.0 for coarse, finer in itertools.pairwise(second)]
    found = [(16.0 * finer - coarse) / 15.0 for coarse, finer in itertools.pairwise(fourth)]
    apart = np.abs(np.diff(found, axis=0))
    return np.take_along_axis(np.array(found[1:]), apart.argmin(axis=0)[None], axis=0)[0]


def test_an_output_has_the_derivative_that_it_has_among_others(native_ratchet_fmu, instance):
    """The search ends with what is asked for; an output that is not linear keeps the others waiting, not otherwise."""
    slave = instance(native_ratchet_fmu)
    inputs, outputs = inputs_and_outputs(slave)
    slave.step(0.0, 0.5)
    for name in inputs:
        together = derivative(slave, outputs, [name], [1.0])
        alone = [derivative(slave, [one], [name], [1.0])[0] for one in outputs]
        assert alone == pytest.approx(together, rel=1e-10, abs=1e-12)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name == "ratchet" else pytest.mark.slow) for name in models.available()]
)
def test_outputs_by_inputs_are_difference_quotients(name, request, instance):
    slave = instance(request.getfixturevalue(f"native_{name}_fmu"))
    inputs, outputs = inputs_and_outputs(slave)
    time = 0.0
    for until in TIMES.get(name, (models.load(name).MODEL.stop_time / 3,)):
        slave.step(time, until - time)
        time = until
        before = slave.get(outputs)
        for one in inputs:
            found = derivative(slave, outputs, [one], [1.0])
            expected = quotient(slave, outputs, one)
            assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * max(1.0, np.abs(expected).max())), one
            said = [one in slave.description.variables[output].depends_on for output in outputs]
            assert not np.abs(found[~np.array(said)]).any(), one  # as modelDescription.xml has it
        assert slave.get(outputs) == before  # nothing has moved


def test_it_is_linear_in_the_seed_and_adjoint_is_its_transpose(built, instance):
    slave = instance(built("ratchet", build_native_fmu, fmi=3))
    slave.step(0.0, 0.5)
    inputs, outputs = inputs_and_outputs(slave)
    columns = np.array([derivative(slave, outputs, [name], [1.0]) for name in inputs])
    seed = np.arange(1.0, len(inputs) + 1)
    assert derivative(slave, outputs, inputs, seed.tolist()) == pytest.approx(seed @ columns, rel=1e-9, abs=1e-12)
    weights = np.linspace(-1.0, 1.0, len(outputs))
    references = [[slave.description.variables[name].reference for name in names] for names in (outputs, inputs)]
    adjoint = slave._instance.getAdjointDerivative(*references, weights.tolist(), len(inputs))
    assert adjoint == pytest.approx(columns @ weights, rel=1e-9, abs=1e-9)


def test_derivatives_of_states_by_states_and_inputs(native_ratchet_fmu, instance):
    """The Jacobian of Model Exchange: velocities are those of the positions, accelerations agree with differences."""
    slave = instance(native_ratchet_fmu, Integrator())
    slave.step(0.0, 0.5)
    rates = [name for name in slave.description.variables if name.startswith("der(")]
    states = [name.removeprefix("der(").removesuffix(")") for name in rates]
    at = np.array(slave.get(states))
    for k, name in enumerate(states):
        found = derivative(slave, rates, [name], [1.0])
        step, ends = 1e-5, []
        for sign in (1.0, -1.0):
            moved = at.copy()
            moved[k] += sign * step
            ends.append(slave.derivatives(0.5, moved))
        slave.derivatives(0.5, at)
        expected = (ends[0] - ends[1]) / (2.0 * step)
        assert found == pytest.approx(expected, rel=1e-5, abs=1e-6 * max(1.0, np.abs(expected).max())), name
    torque = derivative(slave, rates, ["drive_torque"], [1.0])
    assert torque[rates.index("der(wheel.omega)")] != 0.0
    assert slave.get(states) == at.tolist()


@contextmanager
def refused() -> Iterator[None]:
    with pytest.raises(FMICallException) as caught:
        yield
    assert caught.value.status == 3


def test_what_has_no_derivative_is_refused(native_ratchet_fmu, instance):
    slave = instance(native_ratchet_fmu)
    for unknown, known in (
        ("impact_count", "drive_torque"),
        ("impacts[1].time", "drive_torque"),
        ("wheel_angle", "tooth_count"),
        ("wheel_angle", "wheel.phi"),
        ("der(wheel.omega)", "drive_torque"),  # the engine may be ahead
        ("drive_torque", "drive_torque"),
    ):
        with refused():
            derivative(slave, [unknown], [known], [1.0])
    assert derivative(slave, [], [], []).tolist() == []


def test_the_flags_tell_the_truth(built, native_ratchet_fmu, ratchet_fmu):
    said = {}
    for path in (native_ratchet_fmu, ratchet_fmu, built("ratchet", build_native_fmu, fmi=3)):
        with zipfile.ZipFile(path) as archive:
            text = archive.read("modelDescription.xml").decode()
        said[path] = re.findall(r'(provides\w+Derivatives?)="true"', text)
    one = ["providesDirectionalDerivative"]
    both = ["providesDirectionalDerivatives", "providesAdjointDerivatives"]
    assert list(said.values()) == [2 * one, [], 2 * both]
