"""The impacts of all components of a machine, the stress that each leaves, and the damage that all of them do."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import pandas as pd

from mechanism_fmu.stress import STEEL_CARD, Beam, MaterialCard, SequenceDamage

from ...analysis.analyses import Analysis, Seen, analysed, analyses_of
from ...analysis.impacts import Buffer
from ...fmu.declared import Struck
from ...fmu.description import Description, Value
from ...fmu.interface import Component, Observable
from ...run.master import SECOND
from ..machine import Machine
from .watched import watched

# When a component had its first impact in its last step.

_COUNT, _TIME = "impacts_in_step", "impacts[1].time"


def reports_impacts(description: Description) -> bool:
    """Whether a component has the buffer of impacts that this project's FMUs have (docs/reference/fmu.md)."""
    return {_COUNT, _TIME} <= description.variables.keys()


class ImpactTimes:
    """Reads the buffer of impacts (`reports_impacts`).

    Attributes:
        reports: whether the component has it.
    """

    def __init__(self, component: Component) -> None:
        self.reports = reports_impacts(component.description)
        self._component = component
        self._time = component.reals([_TIME] if self.reports else [])

    def first(self) -> int | None:
        """The first nanosecond that is not before the first impact of the last step; None when it had none."""
        if not self.reports or not self._component.get((_COUNT,))[0]:
            return None
        self._time.read()
        return math.ceil(self._time.values[0] * SECOND)


# How often a run repeats what a machine is for: what damage by 1,000 cycles is reported for.

#: So many cycles the damage is reported for.
THOUSAND = 1000


@dataclass(frozen=True)
class Cycles:
    """What is repeated in a run.

    Attributes:
        count: how often, at least 1.
        of: what, in the plural: "strokes" or "runs like this one".
        counted: how it is known, for the reader.
    """

    count: int
    of: str
    counted: str

    def damage_of_thousand(self, damage: float) -> float:
        """What a thousand of them do, if they all do as those of the run, of which all do `damage`."""
        return THOUSAND * damage / self.count


def cycles_of(component: str, counter: str, seen: pd.DataFrame) -> Cycles:
    """The cycles of a component.

    Args:
        component: that is struck.
        counter: its output that counts strokes; "" when none does.
        seen: as of `running.Seen`.
    """
    name = f"{component}.{counter}"
    if counter and name in seen and len(seen):
        strokes = round(abs(float(seen[name].iloc[-1]) - float(seen[name].iloc[0])))
        if strokes:
            return Cycles(strokes, "strokes", f"{name} counts {strokes} in this run")
    return Cycles(1, "runs like this one", "the run as a whole is a cycle")


_LOST = "impacts_lost"

#: The columns before those that the components report, with their units.
_FIRST = {"component": ""}


@dataclass(frozen=True)
class ComponentImpacts:
    """What struck one component.

    Attributes:
        impacts: a row for each impact in the order of time, with its stress when there is a beam.
        lost: impacts that the component could not report.
        struck: what they struck, in words; None when the component declares nothing of the kind.
        beam: the same as a beam; None also when there is none that can be.
        objection: why there is no stress, though the component declares a beam; "" when there is.
        damage: what they have done to the beam; None without a beam or an impact.
    """

    impacts: pd.DataFrame
    lost: int
    struck: Struck | None
    beam: Beam | None
    objection: str
    damage: SequenceDamage | None


class Impacts:
    """An observer of a machine that keeps all impacts that its components report.

    Attributes:
        struck: whether there was an impact since the communication point before.
        units: of the columns of `table`, "1" for numbers without one.
    """

    def __init__(self, machine: Machine) -> None:
        """Look on at each component that has a buffer of impacts, before the machine's first step.

        Args:
            machine: whose components they are.
        """
        self._watches: dict[str, _Watch] = {}
        self._columns: dict[str, dict[str, str]] = {}
        self.units: dict[str, str] = dict(_FIRST)
        for name, part in machine.parts.items():
            own = _Watch(part.component)
            if own.units:
                own.component = watched(machine, name)
                own.component.watchers.append(own)
                self._watches[name] = own
                self._columns[name] = self._join_units(own.units)
        self.struck = False
        self._seen = 0

    def started(self, unit: Observable, time: float) -> None:
        """Read what will be struck.

        Args:
            unit: that is simulated.
            time: of the start [s].
        """
        for own in self._watches.values():
            own.read_sizes()

    def stepped(self, unit: Observable, time: float) -> None:
        """Say whether there were impacts; they have been kept already.

        Args:
            unit: that is simulated.
            time: that is reached [s].
        """
        count = sum(len(own.rows) for own in self._watches.values())
        self.struck, self._seen = count > self._seen, count

    def by_component(self, card: MaterialCard = STEEL_CARD) -> dict[str, ComponentImpacts]:
        """What struck each component that reports impacts.

        Args:
            card: material of the beams.
        """
        return {name: own.result(card) for name, own in self._watches.items()}

    def table(self, by_component: Mapping[str, ComponentImpacts]) -> pd.DataFrame:
        """All impacts in the order of time, with the component's name first; columns of `units`.

        What a component reports in another unit than one before it, as an angle stop its closing speed, has a column of
        its own, which says its unit: "closing_speed [rad/s]".

        Args:
            by_component: what `by_component` returns.
        """
        tables = [
            one.impacts.rename(columns=self._columns[name]).assign(component=name)
            for name, one in by_component.items()
            if len(one.impacts)
        ]
        columns = [name for name in self.units if not tables or any(name in table for table in tables)]
        if not tables:
            return pd.DataFrame(columns=columns)
        whole = pd.concat(tables, ignore_index=True) if len(tables) > 1 else tables[0]
        by_time = whole.sort_values("time", kind="stable") if "time" in whole else whole
        return by_time[columns].reset_index(drop=True)

    def _join_units(self, units: Mapping[str, str]) -> dict[str, str]:
        """The column of each field of a component that is not named like the field."""
        renamed = {}
        for field, unit in units.items():
            if self.units.setdefault(field, unit) != unit:
                renamed[field] = f"{field} [{unit}]"
                self.units[renamed[field]] = unit
        return renamed


class _Watch:
    """A `watched.Watcher` that keeps the impacts of one component.

    Attributes:
        units: of what is reported of an impact, and of its stress; {} when the component reports none.
        rows: what was reported of each impact.
        component: that is asked.
    """

    def __init__(self, component: Component) -> None:
        self.component = component
        description = component.description
        self._buffer = Buffer(description, "impacts")
        self._counts_lost = _LOST in description.variables
        # A chain of links is looked at over the whole motion, which a machine does not keep.
        struck = replace(description.analysis, chain=None)
        self._struck = struck.struck
        self._analyses: tuple[Analysis, ...] = analyses_of(struck, self._buffer.fields) if self._buffer.fields else ()
        self.units = {field: variable.unit or "1" for field, variable in self._buffer.fields.items()}
        for analysis in self._analyses:
            self.units |= analysis.columns
        self.rows: list[list[Value]] = []
        self._lost = 0
        self._sizes: dict[str, Value] = {}

    def read_sizes(self) -> None:
        """Once, after the initialization."""
        if self._analyses and self._struck is not None:
            names = self._struck.variables
            self._sizes = dict(zip(names, self.component.get(names), strict=True))

    def begins(self, time: float) -> None:
        """Nothing has happened yet."""

    def ended(self, time: float) -> None:
        """Keep the impacts of the step."""
        new = self._buffer.read(self.component)
        if new:
            self.rows += new
            if self._counts_lost:
                self._lost = int(self.component.get((_LOST,))[0])

    def memory(self) -> tuple[int, int]:
        """How many there are."""
        return len(self.rows), self._lost

    def remember(self, memory: tuple[int, int]) -> None:
        """Forget those since."""
        count, self._lost = memory
        del self.rows[count:]

    def result(self, card: MaterialCard) -> ComponentImpacts:
        """What they amount to."""
        impacts = pd.DataFrame(self.rows, columns=list(self._buffer.fields))
        found = analysed(self._analyses, Seen(self._sizes, pd.DataFrame(), impacts, card))
        return ComponentImpacts(found.impacts, self._lost, self._struck, found.beam, found.objection, found.damage)
