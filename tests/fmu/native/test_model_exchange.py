"""Model Exchange of native FMUs, driven by FMPy's integrators and by hand."""

import ctypes
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model
from fmpy.validation import validate_fmu

import models
from harness.fmu import open_fmu
from harness.fmu.instances.integration import Integrator
from mechanism_fmu import codes
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.simulation import Simulation

IMPACT = 0.93992117693158
#: Outlines take many looks: so far they are followed [s].
UNTIL = {"geneva_clearance": 1.0, "lever_escapement": 0.5, "pin_pallet": 0.5, "verge": 0.6, "graham": 1.0}
#: What no event happens in, and nothing stiff: any method may be taken.
LINKAGES = ("four_bar", "slider_crank")


@pytest.mark.parametrize(("tolerance", "within"), [(1e-9, 3e-8), (1e-10, 1e-8)])
@pytest.mark.parametrize("fmi", [2, 3])
def test_the_impact_is_found_by_an_integrator_of_others(built, fmi, tolerance, within):
    path = str(built("ratchet", build_native_fmu, fmi=fmi))
    assert validate_fmu(path) == []
    names = ["impact_time", "wheel_angle", "energy_lost"]
    ends = {}
    for kind, solver in (("CoSimulation", {}), ("ModelExchange", {"relative_tolerance": tolerance})):
        found = simulate_fmu(path, fmi_type=kind, stop_time=6.0, output_interval=0.05, output=names, **solver)
        ends[kind] = [found[name][-1] for name in names]
    assert ends["CoSimulation"][0] == pytest.approx(IMPACT, abs=1e-12)
    assert ends["ModelExchange"][0] == pytest.approx(IMPACT, abs=within)
    assert ends["ModelExchange"][1:] == pytest.approx(ends["CoSimulation"][1:], abs=1e-7)


@pytest.mark.parametrize("restitution", [0.3, 0.7])
def test_bounces_end(native_ratchet_fmu, restitution):
    """One event more a hop than co-simulation has; none at one instant for ever."""
    names = ["impact_count", "wheel_angle", "energy_lost"]
    options = {"start_values": {"restitution": restitution}, "output": names, "stop_time": 6.0, "output_interval": 0.05}
    stepped = simulate_fmu(str(native_ratchet_fmu), fmi_type="CoSimulation", **options)
    integrated = simulate_fmu(str(native_ratchet_fmu), fmi_type="ModelExchange", relative_tolerance=1e-10, **options)
    assert integrated["energy_lost"][-1] == pytest.approx(stepped["energy_lost"][-1], rel=1e-6)
    assert integrated["wheel_angle"][-1] == pytest.approx(stepped["wheel_angle"][-1], abs=1e-7)
    assert 0.5 * stepped["impact_count"][-1] < integrated["impact_count"][-1] <= stepped["impact_count"][-1]


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name == "rotary_table" else pytest.mark.slow) for name in models.available()],
)
def test_every_model_goes_the_way_of_co_simulation(name, request):
    path = str(request.getfixturevalue(f"native_{name}_fmu"))
    assert validate_fmu(path) == []
    until = UNTIL.get(name, min(models.load(name).MODEL.stop_time, 2.0))
    outputs = [v.name for v in read_model_description(path).modelVariables if v.causality == "output"]
    names = [one for one in outputs if one.endswith(("_angle", "_speed", "_count", "energy_lost")) and "[" not in one]
    options = {"stop_time": until, "output_interval": until / 50, "output": names}
    stepped = simulate_fmu(path, fmi_type="CoSimulation", **options)
    integrated = simulate_fmu(path, fmi_type="ModelExchange", relative_tolerance=1e-10, **options)
    for one in names:
        if not one.startswith("event"):
            size = max(1.0, float(np.abs(stepped[one]).max()))
            assert integrated[one][-1] == pytest.approx(stepped[one][-1], abs=1e-5 * size), one


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow) for name in LINKAGES])
def test_euler_gets_through_a_linkage(name, request):
    """Of first order: ten times shorter steps, a tenth of the error."""
    path = str(request.getfixturevalue(f"native_{name}_fmu"))
    angle = {"four_bar": "crank_angle", "slider_crank": "crank_angle"}[name]
    exact = simulate_fmu(path, fmi_type="CoSimulation", stop_time=0.2, output_interval=0.1, output=[angle])[angle][-1]
    errors = []
    for step in (1e-3, 1e-4):
        found = simulate_fmu(
            path,
            fmi_type="ModelExchange",
            solver="Euler",
            stop_time=0.2,
            step_size=step,
            output_interval=step,
            output=[angle],
        )
        errors.append(abs(found[angle][-1] - exact))
    assert 8.0 < errors[0] / errors[1] < 12.0


class Model:
    """An instance for Model Exchange, by FMPy's functions."""

    def __init__(self, path: Path, folder: Path) -> None:
        description = read_model_description(str(path))
        self.said: list[str] = []
        self.fmu = FMU2Model(
            guid=description.guid,
            modelIdentifier=description.modelExchange.modelIdentifier,
            unzipDirectory=extract(str(path), str(folder)),
            instanceName="one",
        )
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.states = len(description.derivatives)
        self.indicators = description.numberOfEventIndicators
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()

    def numbers(self, function: str, count: int) -> np.ndarray[Any, np.dtype[np.float64]]:
        values = np.zeros(count)
        getattr(self.fmu, function)(values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), count)
        return values

    def put(self, time: float, states: np.ndarray[Any, np.dtype[np.float64]]) -> None:
        self.fmu.setTime(time)
        self.fmu.setContinuousStates(states.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), len(states))

    def begin(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        self.fmu.exitInitializationMode()
        assert not self.fmu.newDiscreteStates()[0]
        self.fmu.enterContinuousTimeMode()
        return self.numbers("getContinuousStates", self.states)


@pytest.fixture
def model(tmp_path: Path) -> Iterator[Callable[[Path], Model]]:
    """A function that makes instances; they are freed after the test."""
    made: list[Model] = []

    def make(path: Path) -> Model:
        made.append(Model(path, tmp_path / str(len(made))))
        return made[-1]

    yield make
    for one in made:
        one.fmu.freeInstance()


@contextmanager
def refused(status: int) -> Iterator[None]:
    with pytest.raises(FMICallException) as caught:
        yield
    assert caught.value.status == status


def test_states_derivatives_and_nominals_are_variables_of_the_fmu(native_ratchet_fmu, model):
    one = model(native_ratchet_fmu)
    states = one.begin()
    wheel = one.fmu.getReal(
        [one.references[name] for name in ("wheel.phi", "wheel.omega", "wheel_angle", "wheel_speed")]
    )
    assert wheel[:2] == wheel[2:]
    moved = states + 1e-3
    one.put(0.25, moved)
    rates = one.numbers("getDerivatives", one.states)
    named = [v for v in one.references if v.startswith("der(")]
    assert one.fmu.getReal([one.references[name] for name in named]) == rates.tolist()
    assert (
        one.fmu.getReal([one.references[name.removeprefix("der(").removesuffix(")")] for name in named])
        == moved.tolist()
    )
    bodies = (one.states - 2) // 6
    assert rates[: 3 * bodies].tolist() == moved[3 * bodies : 6 * bodies].tolist()
    assert (one.numbers("getNominalsOfContinuousStates", one.states) > 0.0).all()
    assert (one.numbers("getEventIndicators", one.indicators) > 0.0).all()


@pytest.mark.parametrize("off", [-1e-9, 0.0, 1e-9])
def test_an_event_is_due_right_before_its_zero_and_behind_it(native_ratchet_fmu, model, off):
    """Importers stop on either side; and no indicator is zero when event mode is left."""
    one = model(native_ratchet_fmu)
    states, time, size = one.begin(), 0.0, 2e-3
    while size > 1e-12:
        new = _rk4(one, time, states, size)
        one.put(time + size, new)
        if (one.numbers("getEventIndicators", one.indicators) > 0.0).all():
            time, states = time + size, new
            one.fmu.completedIntegratorStep()
        else:
            size /= 2
    one.put(time + off, _rk4(one, time, states, off))
    one.fmu.enterEventMode()
    again, ends, _, changed, _, _ = one.fmu.newDiscreteStates()
    assert (again, ends, changed) == (False, False, True)
    assert (one.numbers("getEventIndicators", one.indicators) > 0.0).all()
    assert one.fmu.getInteger([one.references["impact_count"]]) == [1]
    assert one.fmu.getReal([one.references["impact_time"]]) == pytest.approx([IMPACT + off], abs=1e-9)
    assert not one.fmu.newDiscreteStates()[3]


def _rk4(one: Model, time: float, states: Any, size: float) -> Any:
    def rates(at: float, y: Any) -> Any:
        one.put(at, y)
        return one.numbers("getDerivatives", one.states)

    a = rates(time, states)
    b = rates(time + size / 2, states + size / 2 * a)
    c = rates(time + size / 2, states + size / 2 * b)
    d = rates(time + size, states + size * c)
    return states + size / 6 * (a + 2 * b + 2 * c + d)


def test_a_saved_state_goes_on_alike(native_ratchet_fmu, model):
    one = model(native_ratchet_fmu)
    states = one.begin()
    kept = one.fmu.getFMUState()
    one.put(0.1, states + 1e-4)
    rates = one.numbers("getDerivatives", one.states)
    one.fmu.enterEventMode()
    one.fmu.setFMUState(kept)
    assert one.numbers("getContinuousStates", one.states).tolist() == states.tolist()
    one.put(0.1, states + 1e-4)
    assert one.numbers("getDerivatives", one.states).tolist() == rates.tolist()
    other = model(native_ratchet_fmu)
    other.begin()
    other.fmu.setFMUState(other.fmu.deserializeFMUState(one.fmu.serializeFMUState(kept)))
    assert other.numbers("getContinuousStates", other.states).tolist() == states.tolist()
    one.fmu.freeFMUState(kept)


def test_calls_that_are_refused(native_ratchet_fmu, model):
    error, discard = 3, 2
    one = model(native_ratchet_fmu)
    assert (one.numbers("getNominalsOfContinuousStates", one.states) > 0.0).all()  # as soon as there is an instance
    with refused(error):
        one.fmu.newDiscreteStates()
    states = one.begin()
    with refused(error):
        one.fmu.newDiscreteStates()
    with refused(error):
        one.numbers("getDerivatives", one.states + 1)
    with refused(error):
        one.fmu.setReal([one.references["wheel.phi"]], [1.0])
    with refused(error):
        one.fmu.setTime(float("nan"))
    states[0] = float("nan")
    with refused(discard):
        one.put(0.1, states)
    states[:] = 1e200
    one.put(0.1, states)
    with refused(discard):
        one.numbers("getDerivatives", one.states)
    one.fmu.terminate()


def test_a_step_over_an_impact_is_refused_by_name(native_ratchet_fmu):
    """Who goes on where a gap is below zero, and lets nothing happen, is told which contact it is, and what to do."""
    with open_fmu(native_ratchet_fmu, Integrator()) as fmu, fmu.instantiate("one") as one:
        one.initialize(0.0, 6.0)
        states, _ = one.happen()
        for k in range(1, 96):  # the impact is at 0.93992 s: between the steps to 0.93 and 0.94 s
            a = one.derivatives(0.01 * (k - 1), states)
            b = one.derivatives(0.01 * (k - 0.5), states + 0.005 * a)
            states = states + 0.01 * b  # of second order
            if k < 95:
                one.completed(0.01 * k, states)
        with refused(3):
            one.completed(0.95, states)
        said = one.messages[-1].text
    assert "has stepped over the event of a contact. Let the tool locate state events" in said
    assert "Contact 'face'" in said
    assert "t = 0.95 s" in said


@pytest.mark.slow
@pytest.mark.parametrize("name", LINKAGES)
def test_joints_drift_by_less_than_a_micrometre_in_a_minute(name, request):
    """By Baumgarte's terms alone: nothing happens that would put them right."""
    path = str(request.getfixturevalue(f"native_{name}_fmu"))
    variables = read_model_description(path).modelVariables
    states = [v.name for v in variables if v.causality == "local" and not v.name.startswith("der(")]
    run = simulate_fmu(
        path, fmi_type="ModelExchange", relative_tolerance=1e-8, stop_time=60.0, output_interval=0.5, output=states
    )
    model = models.load(name).MODEL
    simulation = Simulation(model.build(model.values()))
    y, residual = simulation.field("y_end"), simulation.field("residual")
    joint_rows = sum(joint.rows for joint in simulation._mechanism.joints)
    worst = 0.0
    for row in run:
        y[:] = [row[state] for state in states]
        simulation._engine.exchange(codes.EXCHANGE_RATES, row["time"])
        worst = max(worst, np.abs(residual[:joint_rows]).max())
    assert 0.0 < worst < 1e-6


@pytest.mark.parametrize(
    ("changed", "torque"),
    [
        ({"slider_friction": 0.3}, 0.3),
        pytest.param({"joint_friction_radius": 0.003}, 0.3, marks=pytest.mark.slow),
        pytest.param({"joint_friction_radius": 0.003}, -0.1, marks=pytest.mark.slow),
    ],
)
def test_friction_that_reverses(native_slider_crank_fmu, changed, torque):
    """Slip that stops and goes on the other way, again and again."""
    names = ["crank_angle", "crank_speed", "energy_lost"]
    options = {
        "start_values": changed | {"drive_torque": torque},
        "output": names,
        "stop_time": 2.0,
        "output_interval": 0.05,
    }
    path = str(native_slider_crank_fmu)
    stepped = simulate_fmu(path, fmi_type="CoSimulation", **options)
    integrated = simulate_fmu(path, fmi_type="ModelExchange", relative_tolerance=1e-9, **options)
    for name in names:
        size = max(1.0, float(np.abs(stepped[name]).max()))
        assert integrated[name][-1] == pytest.approx(stepped[name][-1], abs=1e-5 * size), name


def test_a_brake_that_an_input_applies_between_events_brakes(native_rotary_table_fmu):
    """From none on: the FMU asks for event mode, in which what rubs is chosen."""
    times = np.linspace(0.0, 2.0, 201)
    ramp = np.zeros(len(times), dtype=[("time", float), ("drive_speed", float), ("brake_torque", float)])
    ramp["time"], ramp["drive_speed"], ramp["brake_torque"] = times, 1.0, np.maximum(0.0, times - 0.5)
    names = ["table_speed", "energy_lost"]
    options = {"input": ramp, "output": names, "stop_time": 2.0, "output_interval": 0.01}
    path = str(native_rotary_table_fmu)
    stepped = simulate_fmu(path, fmi_type="CoSimulation", **options)
    integrated = simulate_fmu(path, fmi_type="ModelExchange", relative_tolerance=1e-8, **options)
    assert stepped["energy_lost"][-1] > 1e-3
    assert integrated["energy_lost"][-1] == pytest.approx(stepped["energy_lost"][-1], rel=0.05)  # held inputs are late


@pytest.mark.parametrize("step", [1e-4, 1e-3, 1e-2, 0.1, 0.2, 0.5])
@pytest.mark.parametrize("restitution", [0.0, 0.3])
def test_fixed_steps_come_near_the_truth_or_are_refused(native_ratchet_fmu, restitution, step):
    path = str(native_ratchet_fmu)
    options = {"start_values": {"restitution": restitution}, "output": ["energy_lost"], "stop_time": 2.0}
    true = simulate_fmu(path, fmi_type="CoSimulation", output_interval=0.1, **options)["energy_lost"][-1]
    try:
        found = simulate_fmu(
            path, fmi_type="ModelExchange", solver="Euler", step_size=step, output_interval=step, **options
        )
    except FMICallException:
        assert step >= 0.1
        return
    assert step <= 0.1
    assert found["energy_lost"][-1] == pytest.approx(true, rel=min(0.5, 20 * step))


def test_what_events_may_change_says_so_and_outputs_depend_on_states(native_ratchet_fmu, built):
    for path in (native_ratchet_fmu, built("ratchet", build_native_fmu, fmi=3)):
        description = read_model_description(str(path))
        local = [v for v in description.modelVariables if v.causality == "local" and not v.name.startswith("event")]
        states, rates = local[: len(local) // 2], local[len(local) // 2 :]
        with zipfile.ZipFile(path) as archive:
            assert archive.read("modelDescription.xml").count(b'reinit="true"') == len(states)
        assert [v.derivative for v in rates] == states
        for output in description.outputs:
            wanted = set(states) if output.variable.variability == "continuous" else set()
            assert {v for v in output.dependencies if v.causality == "local"} == wanted
