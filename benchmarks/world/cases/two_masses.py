"""Two masses on a shaft, cut for co-simulation: each master scheme against the power of its matrix.

    J_1 phi_1'' = -k_1 phi_1 - c_1 phi_1' - tau,   J_2 phi_2'' = -k_2 phi_2 - c_2 phi_2' + tau,
    tau = k (phi_1 - phi_2) + c (phi_1' - phi_2')

Uncut, x = (phi_1, phi_1', phi_2, phi_2') is exp(A t) x(0). Cut at mass 1, that mass is told tau, and mass 2 with the
shaft phi_1 and phi_1'. In a step h an input goes on as u + s t, and a component moves exactly:

    x_j(t + h) = E_j x_j + G_j u + H_j s

s is a linear function of what was exchanged at this communication point and the two before, so that
(x_n, x_n-1, x_n-2) are multiplied by one matrix a step (the first two steps, which have less behind them, apart):

    held       s = 0
    linear     s = (u_n - u_n-1) / h
    rates      s = u_n' + b h / 3, where the derivative is known, with b = (u_n' - u_n-1') / h; else by three values,
               s = (u_n - u_n-1) / h + b h / 2 + b h / 3 with b = (u_n - 2 u_n-1 + u_n-2) / h^2

Gauss and Seidel's scheme moves mass 1 first, and leads mass 2 from where phi_1 and phi_1' were to where they are; with
rates by the mean of the cubic through both ends, (u_n+1 - u_n) / h + (u_n' - u_n+1') / 6.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableSequence, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

from harness.fmu.description import Description, Value, Variable
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Algorithm, GaussSeidel, Jacobi
from harness.report.plot import Curve, Plot
from harness.run.master import Ending, TimeGrid
from mechanism_fmu.model import (
    GROUND,
    CompliantShaft,
    Damper,
    Input,
    Mechanism,
    Output,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

Array = npt.NDArray[np.float64]

J1, K1, C1 = 1.0, 10.0, 0.1
J2, K2, C2 = 2.0, 20.0, 0.2
K, C = 15.0, 0.3
START = (1.0, 0.0, -0.5, 0.0)
STOP, STEP = 2.0, 0.02
_READ = ("angle", "speed")

# The mechanism, whole and in parts.


def mass(name: str, angle: float, inertia: float, stiffness: float, damping: float) -> tuple[Any, ...]:
    """A body at an angle with its pin, and the spring and damper that hold it to the ground."""
    body = rigid_body(name, mass=1.0, inertia=inertia, angle=angle)
    spring = TorsionSpring(f"{name}_spring", body, stiffness=stiffness)
    return body, Revolute(f"{name}_pin", body.at(0, 0), GROUND), spring, Damper(f"{name}_air", body, damping=damping)


def two_masses(tolerance: float, part: str = "whole") -> Mechanism:
    """Both masses on the shaft; or mass "one", which takes its torque; or "two" with the shaft, whose end is led."""
    one, two = mass("one", START[0], J1, K1, C1), mass("two", START[2], J2, K2, C2)
    chosen = {"whole": (one, two), "one": (one,), "two": (two,)}[part]
    shaft: dict[str, tuple[Any, ...]] = {
        "whole": (TorsionSpring("shaft", two[0], one[0], stiffness=K), Damper("loss", two[0], one[0], damping=C)),
        "one": (Torque("shaft", one[0]),),
        "two": (CompliantShaft("shaft", two[0], stiffness=K, damping=C),),
    }
    led = {"whole": (), "one": ("torque",), "two": ("angle", "speed")}[part]
    outputs = [Output(f"{body.name}_{what}", f"{body.name}.{what}", "", "1") for body, *_ in chosen for what in _READ]
    if part == "two":
        outputs.append(Output("torque", "shaft.torque", "", "N.m", feedthrough=led))
    return Mechanism(
        tuple(body for body, *_ in chosen),
        tuple(pin for _, pin, *_ in chosen),
        (*(force for _, _, *forces in chosen for force in forces), *shaft[part]),
        inputs=tuple(Input(name, f"shaft.{name}", 0.0, "", "1") for name in led),
        outputs=tuple(outputs),
        settings=Settings(tolerance),
    )


class Cut:
    """One of both parts as a component of a machine, without an FMU around the engine.

    Attributes:
        name: of the part.
        simulation: of it.
        description: of its variables.
    """

    def __init__(self, name: str, tolerance: float) -> None:
        made = two_masses(tolerance, name)
        self.name, self.simulation = name, Simulation(made)
        follows = {port.name: frozenset(port.feedthrough) for port in made.outputs}
        variables = [Variable(port.name, k, "Real", "input", continuous=True) for k, port in enumerate(made.inputs)]
        variables += [
            Variable(port.name, 9 + k, "Real", "output", continuous=True, depends_on=follows[port.name])
            for k, port in enumerate(made.outputs)
        ]
        known = {variable.name: variable for variable in variables}
        self.description = Description(name, name, "", known, takes_slopes=True, gives_slopes=True)

    def set(self, values: Mapping[str, Value]) -> None:
        """As of `Component`, like all that follows."""
        for name, value in values.items():
            self.simulation.set_input(name, float(value))

    def get(self, names: Sequence[str]) -> list[Value]:
        """Outputs."""
        read = self.simulation.read()
        return [read[name] for name in names]

    def reals(self, names: Sequence[str]) -> CutReals:
        """Bound."""
        return CutReals(self.simulation, list(names))

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Nothing: it has begun where it was made."""

    enter_initialization = initialize

    def exit_initialization(self) -> None:
        """Nothing, likewise."""

    def advance(self, time: float, size: float) -> float:
        """A whole step."""
        self.simulation.advance(time + size)
        return time + size

    def step(self, time: float, size: float) -> None:
        """The same."""
        self.advance(time, size)

    def terminate(self) -> None:
        """Nothing."""

    def save(self, state: Any = None) -> Any:
        """No scheme of these goes back."""
        raise NotImplementedError

    restore = free_state = save


class CutReals:
    """Bound variables of a `Cut`, as of `Reals`."""

    def __init__(self, simulation: Simulation, names: list[str]) -> None:
        self._simulation, self._names = simulation, names
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        """Values of outputs."""
        read = self._simulation.read()
        self.values[:] = [read[name] for name in self._names]

    def read_slopes(self) -> bool:
        """Their derivatives."""
        rates = self._simulation.read_rates()
        self.values[:] = [rates[name] for name in self._names]
        return True

    def write(self) -> None:
        """Values of inputs."""
        for name, value in zip(self._names, self.values, strict=True):
            self._simulation.set_input(name, value)

    def write_slopes(self) -> None:
        """Slopes of inputs."""
        for name, slope in zip(self._names, self.values, strict=True):
            self._simulation.set_slope(name, slope)


CONNECTIONS = (
    Connection("one.one_angle", "two.angle", rate="one.one_speed"),
    Connection("one.one_speed", "two.speed"),
    Connection("two.torque", "one.torque", gain=-1.0),
)
STATE = ("one.one_angle", "one.one_speed", "two.two_angle", "two.two_speed")


class Scheme(NamedTuple):
    """A master algorithm with what is known of outputs."""

    algorithm: Algorithm
    extrapolation: Extrapolation

    @property
    def name(self) -> str:
        """Of both."""
        held = {"constant": "held", "linear": "linear", "derivatives": "rates"}[self.extrapolation]
        return f"{'Jacobi' if isinstance(self.algorithm, Jacobi) else 'Gauss-Seidel'}, {held}"


#: All of them.
SCHEMES = tuple(Scheme(algorithm, known) for algorithm in (Jacobi(), GaussSeidel()) for known in Extrapolation)


def ran(one: Any, two: Any, scheme: Scheme, step: float) -> list[float]:
    """State at the end, of a machine of two components."""
    machine = Machine({"one": one, "two": two}, CONNECTIONS, scheme.extrapolation)
    outcome = run_machine(machine, scheme.algorithm, TimeGrid.of(STOP, step), {})
    assert outcome.ending is Ending.COMPLETED, outcome.error
    return [float(value) for value in machine.get(STATE)]


# What each scheme makes of it, by matrices.

#: A and B of x' = A x + B u, of both components; u is tau, and phi_1 with phi_1'.
ONE = np.array([[0, 1], [-K1 / J1, -C1 / J1]]), np.array([[0], [-1 / J1]])
TWO = np.array([[0, 1], [-(K2 + K) / J2, -(C2 + C) / J2]]), np.array([[0, 0], [K / J2, C / J2]])
#: tau = _TORQUE x, and x' = _WHOLE x.
_TORQUE = np.array([K, C, -K, -C])
_WHOLE = np.block([[ONE[0], np.zeros((2, 2))], [np.zeros((2, 2)), TWO[0]]]) + np.vstack(
    [ONE[1] @ _TORQUE[None], np.hstack([TWO[1], np.zeros((2, 2))])]
)


@cache
def exact(time: float = STOP) -> Array:
    """State of the whole."""
    return np.asarray(expm(_WHOLE * time) @ START)


@cache
def _moves(h: float) -> tuple[tuple[Array, Array, Array], ...]:
    """E, G and H of both components in a step."""
    found = []
    for a, b in (ONE, TWO):
        n, m = b.shape
        block = np.zeros((n + 2 * m, n + 2 * m))
        block[:n, :n], block[:n, n : n + m], block[n : n + m, n + m :] = a, b, np.eye(m)
        moved = expm(block * h)
        found.append((moved[:n, :n], moved[:n, n : n + m], moved[:n, n + m :]))
    return tuple(found)


def after(scheme: Scheme, h: float, past: Sequence[Array]) -> Array:
    """x_n+1 of up to three last states, the last one first: of shape (4,), or (4, m) for m of them at once."""
    (e1, g1, h1), (e2, g2, h2) = _moves(h)
    x = past[0]
    torques = [_TORQUE @ one for one in past]
    pulled, led = np.zeros_like(torques[0]), np.zeros_like(x[:2])
    if scheme.extrapolation is not Extrapolation.CONSTANT and len(past) > 1:
        pulled, led = (torques[0] - torques[1]) / h, (x[:2] - past[1][:2]) / h
    if scheme.extrapolation is Extrapolation.DERIVATIVES:
        led = (_WHOLE @ x)[:2]
        if len(past) > 1:
            led = led + (led - (_WHOLE @ past[1])[:2]) / 3
        if len(past) > 2:
            pulled = pulled + (1 / 2 + 1 / 3) * (torques[0] - 2 * torques[1] + torques[2]) / h
    one = e1 @ x[:2] + g1 @ torques[:1] + h1 @ pulled[None]
    if isinstance(scheme.algorithm, GaussSeidel):
        led = (one - x[:2]) / h
        if scheme.extrapolation is Extrapolation.DERIVATIVES:
            told = ONE[0] @ one + ONE[1] @ (torques[:1] + h * pulled[None])
            led = led + ((_WHOLE @ x)[:2] - told) / 6
    return np.concatenate([one, e2 @ x[2:] + g2 @ x[:2] + h2 @ led])


def by_power(scheme: Scheme, h: float, stop: float = STOP) -> Array:
    """State at the end by the power of the matrix."""
    past = [np.array(START)]
    for _ in range(2):
        past.insert(0, after(scheme, h, past))
    unit = np.eye(12)
    matrix = np.vstack([after(scheme, h, [unit[:4], unit[4:8], unit[8:]]), unit[:8]])
    return np.asarray(np.linalg.matrix_power(matrix, round(stop / h) - 2) @ np.concatenate(past))[:4]


# The case.


def run(tolerance: float) -> Run:
    """Angles at the end: of the whole, and of what each scheme makes of both parts."""
    whole = Simulation(two_masses(tolerance))
    whole.advance(STOP)
    shown = whole.read()
    values, steps = [shown["one_angle"], shown["two_angle"]], steps_of(whole)
    for scheme in SCHEMES:
        one, two = Cut("one", tolerance), Cut("two", tolerance)
        values += ran(one, two, scheme, STEP)[::2]
        steps += steps_of(one.simulation) + steps_of(two.simulation)
    return Run(tuple(values), steps)


def _known() -> Iterator[Known]:
    found = {"uncut": exact()} | {scheme.name: by_power(scheme, STEP) for scheme in SCHEMES}
    for name, state in found.items():
        for number, angle in enumerate(state[::2].tolist(), 1):
            yield Known(f"{name}: angle {number}", "rad", angle, "closed form")


def _error(state: Array) -> float:
    """The larger one of both angles [rad]."""
    return float(np.abs(state - exact())[::2].max())


def _table() -> str:
    """Errors of the schemes, and their order from this step to half of it."""
    rows = [
        f"| scheme | error of an angle at h = {STEP:g} s [rad] | at {STEP / 2:g} s | order |",
        "| --- | --- | --- | --- |",
    ]
    for scheme in SCHEMES:
        coarse, fine = (_error(by_power(scheme, h)) for h in (STEP, STEP / 2))
        rows.append(f"| {scheme.name} | {coarse:.2e} | {fine:.2e} | {np.log2(coarse / fine):.2f} |")
    return "\n".join(rows)


def drawings() -> Sequence[Plot]:
    """Error over communication step: matrices as lines, and the engine's components on them as dots."""
    colours = ("#1f6feb", "#1a7f37", "#8250df", "#d1242f", "#bf8700", "#57606a")
    steps = [0.04 / 2**k for k in range(6)]
    curves = []
    for scheme, colour in zip(SCHEMES, colours, strict=True):
        name = scheme.name.replace("Gauss-Seidel", "G.-S.")
        lines = [by_power(scheme, h) for h in steps]
        dots = [np.array(ran(Cut("one", 1e-10), Cut("two", 1e-10), scheme, h)) for h in steps]
        for states in (lines, dots):
            errors = [np.log10(_error(state)) for state in states]
            curves.append(Curve(name, np.log10(steps), errors, colour, dots=states is dots))
    return [Plot("Error of the cut", "log10 of communication step [s]", "log10 of error of an angle [rad]", curves)]


CASE = Case(
    name="two_masses",
    title="Two masses, cut for co-simulation",
    statement=(
        "Two inertias of 1 and 2 kg m\u00b2, each on a spring and a damper to the ground (10 and 20 N m/rad, 0.1 and "
        "0.2 N m s/rad), joined by a shaft of 15 N m/rad and 0.3 N m s/rad; let go at 1 and \u22120.5 rad. Cut at "
        "the first inertia, which is told the shaft's torque and tells its angle and speed every 0.02 s; 2 s."
    ),
    source=(
        "the usual test of co-simulation masters, as TwoMassRotationalOscillator of S. Glumac's BenchmarkFMUs "
        "(github.com/sglumac/BenchmarkFMUs) and linearOscillator of F. Gonz\u00e1lez's cosim-benchmarks "
        "(github.com/fgonzalezLIM/cosim-benchmarks); data of this project"
    ),
    known=tuple(_known()),
    run=run,
    model=two_masses,
    within=1e-10,
    remark=(
        "What a scheme makes of the cut is known exactly, with all its error: components move by matrix exponentials, "
        "inputs go on in straight lines, so that a run is the power of a matrix. So the tolerance is that of the "
        "engine within each component, and what the cut costs is no part of the deviation. Components are the engine "
        "itself, without an FMU around it; the master is that of machines.\n\n"
        f"What the cut costs, against the exponential of the whole:\n\n{_table()}\n\n"
        "Held inputs take too little energy out: the shaft feels everything late, and at the end half as much again "
        "is left as should be by Jacobi's scheme. With rates the error is of third order at first; in the "
        "first step the torque has no derivative yet and is held, and at small steps that error, of second order, is "
        "what is left. The start moves the masses against each other and excites one mode alone."
    ),
    drawings=drawings,
)
