"""Energy balance of a power bond: what one part gives is not just what the other takes.

A bond is two connections: a flow (a speed) or a displacement (an angle) one way, and an effort (a torque, a force)
the other way. Each part knows the other's quantity only as it was extrapolated from communication points, so that the
two reckon with different powers (Sadjina, Kyllingstad, Skjong, Pedersen: Energy conservation and power bonds in
co-simulations, 2017). See `port` for what is assumed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ...errors import UsageError
from ...fmu.description import Description
from ...fmu.interface import Observable
from ...fmu.units import BASE_UNITS
from ...run.master import SECOND
from ..connection import Connection, own_of, part_of
from ..event_iteration import event_mode_of
from ..machine import Machine
from ..part import Part
from .component_impacts import ImpactTimes
from .watched import watched

# What passes through one side of a bond: the integral of its input times its output.
#
# What is assumed: within a step of a part, its own output goes on a straight line, as its inputs do; that is a
# trapezoid rule, with an error of second order in the step. Where the part had an impact in the step, its output goes
# on as in the step before, jumps at the (first) impact, and goes on in parallel. Where a displacement jumps at a
# communication point, the effort is the mean of before and after.

#: Energy of a straight piece: duration, input at both ends, output at both ends.
Piece = Callable[[float, float, float, float, float], float]


def power(size: float, u0: float, u1: float, y0: float, y1: float) -> float:
    """Integral of the product of input and output."""
    return size * ((u0 * y0 + u1 * y1) / 3 + (u0 * y1 + u1 * y0) / 6)


def effort_taken(_size: float, u0: float, u1: float, y0: float, y1: float) -> float:
    """The input is an effort, the output a displacement."""
    return (u0 + u1) / 2 * (y1 - y0)


def effort_returned(_size: float, u0: float, u1: float, y0: float, y1: float) -> float:
    """The input is a displacement, the output an effort."""
    return (y0 + y1) / 2 * (u1 - u0)


class Port:
    """One side of a bond (a `watched.Watcher`): input and output of one part.

    Attributes:
        energy: so far [J].
    """

    def __init__(self, part: Part, taken: str, given: str, piece: Piece, scale: float) -> None:
        """Look at a part's input `taken` and its output `given`; a piece of energy times `scale` is in J."""
        self._place = part.targets.index(taken)
        self._inputs = part.inputs.values
        self._slopes = part.slopes.values if part.takes_slopes else None
        self._output = part.component.reals([given])
        # Inputs that are set may change it at once, unless the component says that none does.
        # So may an event, which is handled at a communication point.
        by_event = event_mode_of(part.component) is not None
        self._follows = by_event or part.component.description.variables[given].depends_on != frozenset()
        self._impacts = ImpactTimes(part.component)
        self._jumps = self._impacts.reports and piece is not effort_taken  # a displacement does not jump
        self._piece, self._scale = piece, scale
        self._point: tuple[float, float, float] | None = None
        self._slope = 0.0
        self.energy = 0.0

    def exchanged(self, time: float) -> None:
        """Inputs were set at a communication point; where a displacement jumps, energy passes at once."""
        if self._piece is not power:
            self.begins(time)

    def begins(self, time: float) -> None:
        """The input may have jumped."""
        if self._point is None or self._follows:
            self._output.read()
        self._go_to(time, self._inputs[self._place], self._output.values[0])

    def ended(self, time: float) -> None:
        """Add what has passed in a step."""
        assert self._point is not None
        begin, u, y = self._point
        size = time - begin
        rate = 0.0 if self._slopes is None else self._slopes[self._place]
        self._output.read()
        end = self._output.values[0]
        first = self._impacts.first() if self._jumps else None
        if first is not None:
            impact = min(max(first / SECOND - begin, 0.0), size)
            self._go_to(begin + impact, u + rate * impact, y + self._slope * impact)
            self._point = begin + impact, u + rate * impact, end - self._slope * (size - impact)
        elif size > 0.0:
            self._slope = (end - y) / size
        self._go_to(time, u + rate * size, end)

    def memory(self) -> tuple[float, tuple[float, float, float] | None, float, float]:
        """All that changes."""
        return self.energy, self._point, self._slope, self._output.values[0]

    def remember(self, memory: tuple[float, tuple[float, float, float] | None, float, float]) -> None:
        """Be as then."""
        self.energy, self._point, self._slope, self._output.values[0] = memory

    def _go_to(self, time: float, u: float, y: float) -> None:
        """Add what passes on straight lines of input and output."""
        if self._point is not None:
            begin, u0, y0 = self._point
            self.energy += self._scale * self._piece(time - begin, u0, u, y0, y)
        self._point = time, u, y


#: The columns of `bond_rows`.
HEADINGS = ("bond", "given [J]", "taken [J]", "made by\nthe coupling [J]", "largest\npassed [J]", "made / largest [%]")

_POWER = {"kg": 1, "m": 2, "s": -3}
_WORK = {"kg": 1, "m": 2, "s": -2}


@dataclass(frozen=True)
class Bond:
    """A power bond.

    Attributes:
        flow: speed or displacement, from the driving part to the driven one.
        effort: back, with the sign that it has on the driving part.
        reaction: what the output behind `effort` is: the effort that acts on the driven part, as the shafts of this
            project return it, so that the driving part must get its negative; or (True) the reaction to it, which
            acts on the driving part as it is.
    """

    flow: Connection
    effort: Connection
    reaction: bool = False


def pushes(bond: Bond) -> bool:
    """Whether the gains let the driving part be pushed on by what it drives; a gear turns both of them round."""
    return (bond.flow.gain * bond.effort.gain > 0.0) is not bond.reaction


@dataclass(frozen=True)
class BondEnergy:
    """Energies over a run [J].

    Attributes:
        given: by the driving part [J].
        taken: by the driven part [J].
        most: largest size [J] of the energy that had passed at any time, on either side: what to compare `made` with.
    """

    given: float
    taken: float
    most: float

    @property
    def made(self) -> float:
        """What the coupling has added."""
        return self.taken - self.given


class Bonds:
    """An observer of a machine that adds up the energies over bonds while it runs, for steps of any size."""

    def __init__(self, machine: Machine, bonds: Mapping[str, Bond]) -> None:
        """Look on at the parts on both sides of each bond, before the machine's first step.

        Args:
            machine: in which the connections of the bonds are.
            bonds: by name.

        Raises:
            UsageError: one that is no power bond; the message says why.
        """
        self._ends = {name: _ends(machine, name, bond) for name, bond in bonds.items()}
        self._most = dict.fromkeys(bonds, 0.0)

    def started(self, unit: Observable, time: float) -> None:
        """Nothing has passed yet.

        Args:
            unit: that is simulated.
            time: of the start [s].
        """
        self.stepped(unit, time)

    def stepped(self, unit: Observable, time: float) -> None:
        """Look at how much has passed; the exchange at this communication point may have moved something.

        Args:
            unit: that is simulated.
            time: that is reached [s].
        """
        for name, (driving, driven) in self._ends.items():
            driving.exchanged(time)
            driven.exchanged(time)
            self._most[name] = max(self._most[name], abs(driving.energy), abs(driven.energy))

    def energies(self) -> dict[str, BondEnergy]:
        """So far, by bond."""
        return {name: BondEnergy(a.energy, b.energy, self._most[name]) for name, (a, b) in self._ends.items()}


def bond_rows(energies: Mapping[str, BondEnergy]) -> list[list[str]]:
    """The cells below `HEADINGS`, for `terminal.show_table`."""
    return [
        [name, *(f"{energy:.4g}" for energy in (e.given, e.taken, e.made, e.most)), _percent(e.made, e.most)]
        for name, e in energies.items()
    ]


def bond_summary(energies: Mapping[str, BondEnergy]) -> dict[str, dict[str, float]]:
    """By bond, ready for JSON [J]."""
    return {
        name: {"given": e.given, "taken": e.taken, "made": e.made, "largest": e.most} for name, e in energies.items()
    }


def _ends(machine: Machine, name: str, bond: Bond) -> tuple[Port, Port]:
    """The driving and the driven side of a bond, each watching its part."""
    flow, effort = bond.flow, bond.effort
    driving, driven = part_of(flow.source), part_of(flow.target)
    if (part_of(effort.source), part_of(effort.target)) != (driven, driving):
        raise UsageError(
            f"Bond '{name}': its flow goes from {driving} to {driven}, so its effort must go from {driven} to "
            f"{driving}, but it is {effort}."
        )
    for connection in (flow, effort):
        part, _, own = connection.target.partition(".")
        if part not in machine.parts or own not in machine.parts[part].targets:
            raise UsageError(f"Bond '{name}': the machine has no connection to {connection.target}.")
    scales, works = zip(
        _energy_unit(machine.description, name, (flow.source, flow.target), (effort.target, effort.source)),
        _energy_unit(machine.description, name, (flow.target, flow.source), (effort.source, effort.target)),
        strict=True,
    )
    # What moves against the effort gives energy.
    turned = -1.0 if bond.reaction else 1.0
    giving = effort_taken if works[0] else power
    taking = effort_returned if works[1] else power
    watchers = [watched(machine, part).watchers for part in (driving, driven)]
    giver = Port(machine.parts[driving], own_of(effort.target), own_of(flow.source), giving, -scales[0])
    taker = Port(machine.parts[driven], own_of(flow.target), own_of(effort.source), taking, turned * scales[1])
    watchers[0].append(giver)
    watchers[1].append(taker)
    return giver, taker


def _energy_unit(
    description: Description, bond: str, flows: tuple[str, str], efforts: tuple[str, str]
) -> tuple[float, bool]:
    """The product of two variables' units in SI units, and whether it is a work, and not a power.

    Each comes with the variable at the connection's other end, whose unit it has if it has none. Variables without
    units are taken as a power in SI units. Radians do not count.
    """
    (flow, _), (effort, _) = flows, efforts
    pairs = [[description.variable(name).unit for name in names] for names in (flows, efforts)]
    units = [own or other for own, other in pairs]
    if not any(units):
        return 1.0, False
    first, second = (description.units.meaning(unit) for unit in units)
    if first is not None and second is not None:
        product = first * second
        found = {unit: n for unit, n in zip(BASE_UNITS, product.exponents, strict=True) if n and unit != "rad"}
        if found in (_POWER, _WORK):
            return product.factor, found == _WORK
    raise UsageError(
        f"Bond '{bond}': {flow} [{units[0] or '1'}] times {effort} [{units[1] or '1'}] is neither a power nor a work; "
        "a bond has a speed or a displacement, and the force or torque that belongs to it."
    )


def _percent(made: float, most: float) -> str:
    return f"{100.0 * made / most:.2g}" if most > 0.0 else "-"
