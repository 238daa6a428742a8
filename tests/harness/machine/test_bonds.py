"""Energy over power bonds: against the energies of the parts themselves, which are known exactly."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from harness.errors import FmuError, UsageError
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.observers.bonds import HEADINGS, Bond, BondEnergy, Bonds, bond_rows, bond_summary, pushes
from harness.machine.part import Extrapolation
from harness.machine.running import bond_cautions, run_machine
from harness.machine.stepping import Adaptive, Algorithm, EventAware, GaussSeidel, Jacobi
from harness.run.master import Ending, TimeGrid
from tests.harness.machine.fakes import Wheel
from tests.harness.machine.linear import Linear, mass, mass_and_spring

STOP = 2.0
LED_BY_DISPLACEMENT = Bond(Connection("one.x", "two.led", rate="one.v"), Connection("two.force", "one.force"), True)
ALGORITHMS: dict[str, Callable[[Machine], Algorithm]] = {
    "jacobi": lambda _: Jacobi(),
    "gauss_seidel": lambda _: GaussSeidel(),
    "event_aware": EventAware,
}
LED_BY_SPEED = Bond(Connection("one.v", "two.led"), Connection("two.force", "one.force"), True)


def led_by_speed(name: str, m: float = 1.0, k: float = 1.0, kc: float = 0.5) -> Linear:
    """As `mass_and_spring`, but the end of the coupling spring has a speed that is led: states x, v, end."""
    matrices = (
        [[0, 1, 0], [-(k + kc) / m, 0, kc / m], [0, 0, 0]],
        [[0], [0], [1]],
        [[1, 0, 0], [0, 1, 0], [kc, 0, -kc]],
        [[0], [0], [0]],
    )
    return Linear(name, matrices, {"led": "m/s"}, {"x": "m", "v": "m/s", "force": "N"}, (0.0, 0.0, 1.0))


def displacement_machine(extrapolation: Extrapolation) -> Machine:
    bond = LED_BY_DISPLACEMENT
    return Machine({"one": mass("one"), "two": mass_and_spring("two")}, [bond.flow, bond.effort], extrapolation)


def speed_machine(extrapolation: Extrapolation) -> Machine:
    bond = LED_BY_SPEED
    return Machine({"one": mass("one"), "two": led_by_speed("two")}, [bond.flow, bond.effort], extrapolation)


def energies(machine: Machine) -> tuple[float, float]:
    """Of both parts [J], each with its own springs; masses and springs to the ground are 1, the coupling spring 0.5."""
    one, two = (machine.parts[name].component for name in ("one", "two"))
    x, v, force = (float(value) for value in two.get(["x", "v", "force"]))
    stretch = force / 0.5
    first = sum(float(value) ** 2 / 2 for value in one.get(["x", "v"]))
    return first, x**2 / 2 + v**2 / 2 + 0.5 * stretch**2 / 2


def ran(machine: Machine, bond: Bond, algorithm: Algorithm, step: float) -> tuple[BondEnergy, float, float]:
    """What the bond says, and by how much the energies of the parts have changed."""
    bonds = Bonds(machine, {"spring": bond})

    class Before:
        def __init__(self) -> None:
            self.energies: list[tuple[float, float]] = []

        def started(self, unit: Any, time: float) -> None:
            self.energies.append(energies(machine))

        def stepped(self, unit: Any, time: float) -> None:
            pass

    before = Before()
    outcome = run_machine(machine, algorithm, TimeGrid.of(STOP, step), {}, [bonds, before])
    assert outcome.ending is Ending.COMPLETED, outcome.error
    after = energies(machine)
    return bonds.energies()["spring"], after[0] - before.energies[0][0], after[1] - before.energies[0][1]


def test_a_displacement_that_is_held_is_reckoned_exactly() -> None:
    """The total energy error of an oscillator split in two is the residual of its bond."""
    machine = displacement_machine(Extrapolation.CONSTANT)
    energy, one, two = ran(machine, LED_BY_DISPLACEMENT, Jacobi(), 0.05)
    assert energy.given == pytest.approx(-one, abs=1e-12)
    assert energy.taken == pytest.approx(two, abs=1e-12)
    assert energy.made == pytest.approx(one + two, abs=1e-12)
    assert energy.made > 0.01


@pytest.mark.parametrize("extrapolation", Extrapolation)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize(
    ("build", "bond"), [(displacement_machine, LED_BY_DISPLACEMENT), (speed_machine, LED_BY_SPEED)]
)
def test_the_energy_that_a_coupling_makes_is_that_by_which_the_total_changes(
    build: Any, bond: Bond, algorithm: str, extrapolation: Extrapolation
) -> None:
    """What the straight lines leave out vanishes with the second order, whatever the order of the scheme."""
    steps, missed = (0.08, 0.04), []
    for step in steps:
        machine = build(extrapolation)
        energy, one, two = ran(machine, bond, ALGORITHMS[algorithm](machine), step)
        missed.append(abs(energy.made - (one + two)))
        assert energy.most >= abs(energy.given)
    assert (np.array(missed) < 0.06 * np.square(steps)).all()


def line(name: str, start: float, slope: float, taken: str, told: str) -> Linear:
    """Its output is start + slope t, whatever it takes."""
    matrices = ([[0, 1], [0, 0]], [[0], [0]], [[1, 0]], [[0]])
    return Linear(name, matrices, {"taken": taken}, {"told": told}, (start, slope))


def lines(
    speed: str = "rad/s",
    torque: str = "N.m",
    gain: float = -1.0,
    flow_gain: float = 1.0,
    reaction: bool = False,
    driver: tuple[str, str] = ("N.m", "rad/s"),
) -> tuple[Machine, Bond]:
    """A driver with speed 1 + t, a driven part with torque 2 - t; each in its own units."""
    bond = Bond(Connection("a.told", "b.taken", gain=flow_gain), Connection("b.told", "a.taken", gain=gain), reaction)
    parts = {"a": line("a", 1.0, 1.0, *driver), "b": line("b", 2.0, -1.0, speed, torque)}
    return Machine(parts, [bond.flow, bond.effort]), bond


def test_a_bond_reckons_what_each_side_had() -> None:
    """In steps of 0.5, each has the other's old value."""
    machine, bond = lines()
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.5), {}, [bonds])
    energy = bonds.energies()["shaft"]
    assert energy.given == pytest.approx(0.5 * (2.0 * 1.25 + 1.5 * 1.75))
    assert energy.taken == pytest.approx(0.5 * (1.75 * 1.0 + 1.25 * 1.5))
    assert energy.made == pytest.approx(energy.taken - energy.given)
    assert energy.most == energy.given
    row = ["shaft", "2.562", "1.812", "-0.75", "2.562", "-29"]
    assert bond_rows({"shaft": energy}) == [row]
    assert len(row) == len(HEADINGS)
    assert bond_summary({"shaft": energy})["shaft"]["made"] == energy.made


def test_steps_may_have_any_size() -> None:
    """The last one of the grid is shorter; with straight inputs and outputs nothing is left out."""
    bond = Bond(Connection("a.told", "b.taken"), Connection("b.told", "a.taken", gain=-1.0))
    parts = {"a": line("a", 1.0, 1.0, "N.m", "rad/s"), "b": line("b", 2.0, -1.0, "rad/s", "N.m")}
    machine = Machine(parts, [bond.flow, bond.effort], Extrapolation.DERIVATIVES)
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.3), {}, [bonds])
    energy = bonds.energies()["shaft"]
    exact = 2.0 + 1.0 / 2 - 1.0 / 3  # the integral of (1 + t) (2 - t)
    assert (energy.given, energy.taken) == pytest.approx((exact, exact), rel=1e-14)


@pytest.mark.parametrize(
    ("how", "ratio"),
    [
        ({"speed": "rpm"}, 1.0),
        ({"torque": "kN.m"}, 1000.0),
        ({"gain": -3.0, "flow_gain": 3.0}, 3.0),
        ({"gain": 1.0, "reaction": True}, 1.0),
        ({"gain": 3.0, "flow_gain": -3.0}, 3.0),
    ],
)
def test_units_gears_and_signs_do_not_matter(how: dict[str, Any], ratio: float) -> None:
    machine, bond = lines(**how)
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.01), {}, [bonds])
    energy = bonds.energies()["shaft"]
    sign = -1.0 if bond.reaction else math.copysign(1.0, bond.flow.gain)
    exact = sign * ratio * (2.0 + 1.0 / 2 - 1.0 / 3)
    assert not pushes(bond)
    assert energy.given == pytest.approx(exact, rel=0.01)
    assert energy.taken == pytest.approx(exact, rel=0.01)


@pytest.mark.parametrize(
    "how",
    [
        {"speed": "", "torque": "", "driver": ("", "")},
        {"speed": "", "torque": ""},
        {"driver": ("", "")},
        {"speed": "rad/s", "torque": "", "driver": ("N.m", "")},
    ],
    ids=["none has", "the driver has", "the driven part has", "one each"],
)
def test_units_that_one_side_lacks_are_those_of_the_other_and_without_any_it_is_a_power(how: dict[str, Any]) -> None:
    machine, bond = lines(**how)
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.01), {}, [bonds])
    energy = bonds.energies()["shaft"]
    exact = 2.0 + 1.0 / 2 - 1.0 / 3
    assert (energy.given, energy.taken) == pytest.approx((exact, exact), rel=0.01)


def test_a_missing_gain_of_minus_one_shows() -> None:
    """The driver is pushed on by what it drives: both give, and the coupling makes the double."""
    machine, bond = lines(gain=1.0)
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.01), {}, [bonds])
    energy = bonds.energies()["shaft"]
    exact = 2.0 + 1.0 / 2 - 1.0 / 3
    assert (energy.given, energy.taken) == pytest.approx((-exact, exact), rel=0.01)
    assert energy.made == pytest.approx(2 * exact, rel=0.01)
    assert pushes(bond)
    assert not pushes(lines()[1])
    assert not pushes(LED_BY_SPEED)


def test_what_is_made_vanishes_with_the_step_and_almost_so_when_inputs_go_on() -> None:
    def made(extrapolation: Extrapolation, step: float) -> float:
        return ran(displacement_machine(extrapolation), LED_BY_DISPLACEMENT, Jacobi(), step)[0].made

    coarse, fine = made(Extrapolation.CONSTANT, 0.02), made(Extrapolation.CONSTANT, 0.01)
    assert math.log2(coarse / fine) == pytest.approx(1.0, abs=0.02)
    assert abs(made(Extrapolation.DERIVATIVES, 0.02)) < 1e-3 * coarse


def test_what_only_the_driven_part_has_taken_has_passed_as_well() -> None:
    """The driving part stands still, though the connection tells the other that it has a speed."""
    bond = Bond(Connection("a.told", "b.taken", offset=2.0), Connection("b.told", "a.taken", gain=-1.0))
    parts = {"a": line("a", 0.0, 0.0, "N.m", "rad/s"), "b": line("b", 3.0, 0.0, "rad/s", "N.m")}
    machine = Machine(parts, [bond.flow, bond.effort])
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 1.0), {}, [bonds])
    energy = bonds.energies()["shaft"]
    assert energy.given == 0.0
    assert energy.most == abs(energy.taken) == pytest.approx(6.0)
    assert "where 6 J passed at most" in bond_cautions({"shaft": energy}, 1.0)[0].text


def test_what_is_taken_back_has_not_passed() -> None:
    """Steps by tolerance: each is tried as a whole, taken back, and taken in halves."""
    machine = displacement_machine(Extrapolation.CONSTANT)
    energy, one, two = ran(machine, LED_BY_DISPLACEMENT, Adaptive(machine, 1e-3), 1.0)
    assert machine.parts["one"].statistics.rollbacks > 5
    assert energy.given == pytest.approx(-one, abs=1e-12)
    assert energy.taken == pytest.approx(two, abs=1e-12)


def test_a_step_that_another_part_did_not_complete_has_passed_nothing() -> None:
    class Failing(Linear):
        def advance(self, time: float, size: float) -> float:
            if time > 0.45:
                raise FmuError("it breaks")
            return super().advance(time, size)

    def passed(*, fails: bool) -> BondEnergy:
        machine = displacement_machine(Extrapolation.CONSTANT)
        if fails:
            matrices = [[0.0]], [[0.0]], [[0.0]], [[0.0]]
            parts = {name: part.component for name, part in machine.parts.items()}
            bond = LED_BY_DISPLACEMENT
            failing = Failing("failing", matrices, {"u": "1"}, {"y": "1"}, (0.0,))
            machine = Machine(parts | {"failing": failing}, [bond.flow, bond.effort])
        bonds = Bonds(machine, {"spring": LED_BY_DISPLACEMENT})
        outcome = run_machine(machine, Jacobi(), TimeGrid.of(1.0 if fails else 0.5, 0.1), {}, [bonds])
        assert outcome.final_time == 0.5
        return bonds.energies()["spring"]

    assert passed(fails=True) == passed(fails=False)


def test_the_speed_jumps_at_an_impact_and_not_evenly_in_the_step_before() -> None:
    """A wheel under a torque of 0.5: speed 1 + t / 2, doubled at 0.234 s."""
    bond = Bond(Connection("wheel.speed", "b.taken"), Connection("b.told", "wheel.torque"))
    parts = {"wheel": Wheel("wheel", (0.234,)), "b": line("b", 0.5, 0.0, "rad/s", "N.m")}
    machine = Machine(parts, [bond.flow, bond.effort], Extrapolation.DERIVATIVES)
    bonds = Bonds(machine, {"shaft": bond})
    run_machine(machine, EventAware(machine), TimeGrid.of(0.4, 0.1), {}, [bonds])
    angle = (0.234 + 0.234**2 / 4) + 2 * 1.117 * 0.166 + 0.166**2 / 4
    assert machine.get(["wheel.angle"]) == [pytest.approx(angle, rel=1e-12)]
    assert bonds.energies()["shaft"].given == pytest.approx(-0.5 * angle, rel=1e-12)


def test_parts_that_take_no_slopes_reckon_with_the_middle_of_the_step() -> None:
    how = {"slopes": False}
    bond = LED_BY_DISPLACEMENT
    parts = {"one": mass("one", **how), "two": mass_and_spring("two", **how)}
    machine = Machine(parts, [bond.flow, bond.effort], Extrapolation.DERIVATIVES)
    energy, one, two = ran(machine, bond, Jacobi(), 0.05)
    assert energy.given == pytest.approx(-one, abs=1e-12)
    assert energy.made == pytest.approx(one + two, abs=1e-12)


@pytest.mark.parametrize(
    ("flow", "effort", "message"),
    [
        (("one.x", "two.led"), ("one.v", "one.force"), "so its effort must go from two to one, but it is one.v -> one"),
        (("one.x", "two.led"), ("two.v", "one.force"), "two.led [m] times two.v [m/s] is neither a power nor a work"),
        (("one.x", "two.lod"), ("two.force", "one.force"), "the machine has no connection to two.lod"),
    ],
)
def test_what_is_no_bond_is_refused(flow: tuple[str, str], effort: tuple[str, str], message: str) -> None:
    machine = displacement_machine(Extrapolation.CONSTANT)
    with pytest.raises(UsageError) as refusal:
        Bonds(machine, {"spring": Bond(Connection(*flow), Connection(*effort))})
    assert message in str(refusal.value)
