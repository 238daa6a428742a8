"""Post-processing of a run: a list of analyses, each for what the FMU declares of its own (`declared.Declared`)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import pandas as pd

from mechanism_fmu.stress import Beam, MaterialCard, SequenceDamage

from ..errors import FmuError
from ..fmu.declared import Chain, Declared, Struck
from ..fmu.description import Value
from .compliance import Compliance, compliance_of, compliance_units
from .stress import DAMAGE_UNITS, STRESS_COLUMNS, beam_of, damage_of_impacts, with_stress


@dataclass(frozen=True)
class Seen:
    """What analyses look at.

    Attributes:
        parameters: also calculated ones, by name.
        results: a row for each communication point, in SI units.
        impacts: a row for each impact.
        card: material of what is struck.
    """

    parameters: Mapping[str, Value]
    results: pd.DataFrame
    impacts: pd.DataFrame
    card: MaterialCard


@dataclass(frozen=True)
class Analysed:
    """What analyses have found.

    Attributes:
        impacts: as seen, with the stress that each leaves.
        beam: that they strike; None when none is declared, or the one that is cannot be.
        damage: what all impacts together do to it; None without a beam or an impact.
        compliance: how far links give way; () when none are declared, or nothing loads them.
        objection: why a declared beam has no stress; "" when it has.
    """

    impacts: pd.DataFrame
    beam: Beam | None = None
    damage: SequenceDamage | None = None
    compliance: tuple[Compliance, ...] = ()
    objection: str = ""


class Analysis(Protocol):
    """One way to look at a run; it reads one part of what the FMU declares.

    Attributes:
        variables: parameters and calculated parameters without which it can say nothing.
        columns: units of the columns that it adds to the table of impacts.
        tables: units of the numbers that it finds besides, by the name of their table.
    """

    @property
    def variables(self) -> tuple[str, ...]:
        """Their names."""

    @property
    def columns(self) -> Mapping[str, str]:
        """By name; "1" of a number without a unit, "" of a text; none unless it says so."""
        return {}

    @property
    def tables(self) -> Mapping[str, Mapping[str, str]]:
        """By table and name; none unless it says so."""
        return {}

    def analyse(self, seen: Seen, found: Analysed) -> Analysed:
        """What has been found before, and what this analysis finds.

        Raises:
            FmuError: the FMU reports what cannot be.
        """


@dataclass(frozen=True)
class _OfBeam(Analysis):
    """An analysis of the beam that impacts strike."""

    struck: Struck

    @property
    def variables(self) -> tuple[str, ...]:
        """Sizes of the beam."""
        return self.struck.variables


@dataclass(frozen=True)
class Stress(_OfBeam):
    """The beam that is struck, and the stress that each impact leaves in it."""

    @property
    def columns(self) -> Mapping[str, str]:
        """Stress, its place and delay, and a remark."""
        return STRESS_COLUMNS

    def analyse(self, seen: Seen, found: Analysed) -> Analysed:
        """The beam, and the columns; neither where its damage has been objected to.

        Raises:
            FmuError: a beam that cannot be, or an impact that the stress model does not reach.
        """
        if found.objection:
            return found
        beam = beam_of(self.struck, seen.parameters)
        return replace(found, beam=beam, impacts=with_stress(found.impacts, self.struck, beam, seen.card.material))


@dataclass(frozen=True)
class Damage(_OfBeam):
    """What all impacts together do to the beam."""

    @property
    def tables(self) -> Mapping[str, Mapping[str, str]]:
        """The numbers of a `SequenceDamage`."""
        return {"fatigue": DAMAGE_UNITS}

    def analyse(self, seen: Seen, found: Analysed) -> Analysed:
        """The damage.

        Raises:
            FmuError: a beam that cannot be, or an impact that the stress model does not reach.
        """
        beam = beam_of(self.struck, seen.parameters)
        return replace(found, damage=damage_of_impacts(seen.impacts, self.struck, beam, seen.card))


@dataclass(frozen=True)
class Yielding(Analysis):
    """How far the links of a chain give way."""

    chain: Chain

    @property
    def variables(self) -> tuple[str, ...]:
        """Sizes of the links."""
        return self.chain.variables

    @property
    def tables(self) -> Mapping[str, Mapping[str, str]]:
        """The numbers of a `Compliance`."""
        return {"compliance": compliance_units(self.chain)}

    def analyse(self, seen: Seen, found: Analysed) -> Analysed:
        """What gives way most."""
        return replace(found, compliance=compliance_of(self.chain, seen.parameters, seen.results, seen.impacts))


def analyses_of(declared: Declared, fields: Iterable[str]) -> tuple[Analysis, ...]:
    """The analyses that an FMU declares, of which its records of impacts have the `fields`."""
    struck, chain = declared.struck, declared.chain
    of_impacts = (Damage(struck), Stress(struck)) if struck is not None and struck.jump in set(fields) else ()
    return (*of_impacts, *((Yielding(chain),) if chain is not None else ()))


def analysed(analyses: Iterable[Analysis], seen: Seen) -> Analysed:
    """What all of them find; where the FMU reports what cannot be, there is an objection, and no stress.

    A run that never began has no parameters, and nothing is found.
    """
    found = Analysed(seen.impacts)
    for analysis in analyses:
        if not set(analysis.variables) <= set(seen.parameters):
            continue
        try:
            found = analysis.analyse(seen, found)
        except FmuError as error:
            found = Analysed(seen.impacts, compliance=found.compliance, objection=str(error))
    return found
