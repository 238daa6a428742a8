"""What the C surface knows of a model: the members of `Model` in model.h, and the tables they point to."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from ...model import Mechanism, Model, compile_mechanism
from ...model.compile import unknown_names
from ...tables.layout import FIELDS, pack, slot
from ...tables.sizes import sizes_of
from ..instance.saved_state import Rule, rules
from ..parts.states import states_of
from ..parts.variables import FIRST_REFERENCE, Variable, variables_of
from .description3 import Again, outputs_again
from .formulas import Formulas

#: As in model.h, in the order of its enumerations.
_TYPES = ("Real", "Integer", "Boolean")
_CAUSALITIES = ("input", "output", "parameter", "calculatedParameter")


class Bits(int):
    """A word of a block: 64 bits, whatever they stand for."""


#: Of a C structure: a text is a pointer to it, a whole number an `int` or `size_t`, any other a `double`.
Cell = str | int | float


@dataclass(frozen=True)
class Table:
    """A C array.

    Attributes:
        kind: C type of its elements.
        name: of the array.
        rows: the members of each element; of a plain type there is one.
    """

    kind: str
    name: str
    rows: tuple[tuple[Cell, ...], ...]


#: The members of `Model` by name, in the order of model.h.
ModelData = dict[str, Cell | bytes | Table]


def model_data(model: Model, formulas: Formulas, guid: str, mark: bytes, clocks: bool = False) -> ModelData:
    """All that the C surface gets to know.

    Args:
        model: the model.
        formulas: its parameters-to-tables function, traced.
        guid: of the FMU.
        mark: 16 bytes by which a serialized state is recognised.
        clocks: whether FMI 3.0 has a clock of impacts, and arrays.
    """
    mechanism = model.mechanism(model.values())
    block = pack(compile_mechanism(mechanism))
    first_of_work = next(field.name for field in FIELDS if field.section == "work")
    given = int(block.view("int64")[slot(first_of_work)])
    variables = variables_of(model)
    again = outputs_again(variables) if clocks else ()
    held = rules(sizes_of(block))
    counts = {c: sum(v.causality == c for v in variables) for c in _CAUSALITIES}
    return {
        "name": model.name,
        "guid": guid,
        "mark": mark,
        "variables": Table("Variable", "VARIABLES", tuple(map(_variable, variables))),
        "variable_count": len(variables),
        "inputs": counts["input"],
        "outputs": counts["output"],
        "parameters": counts["parameter"],
        "has_clock": int(clocks),
        "again": Table("Again", "AGAIN", tuple(map(_again, again))),
        "again_count": len(again),
        "block": Table("uint64_t", "BLOCK", tuple((Bits(word),) for word in block[:given].view("uint64").tolist())),
        "given": given,
        "words": len(block),
        "numbers": formulas.findings,
        "objections": Table("Finding", "OBJECTIONS", formulas.objections),
        "problems": Table("Finding", "PROBLEMS", formulas.problems),
        "warnings": Table("Finding", "WARNINGS", formulas.warnings),
        "objection_count": len(formulas.objections),
        "problem_count": len(formulas.problems),
        "warning_count": len(formulas.warnings),
        "dependent": Table("Word", "DEPENDENT", formulas.words),
        "dependent_count": len(formulas.words),
        **_names(mechanism),
        "rules": Table("Rule", "RULES", tuple(map(_rule, held))),
        "rule_count": len(held),
        "nominals": Table("double", "NOMINALS", tuple((float(state.nominal),) for state in states_of(mechanism))),
    }


def _names(mechanism: Mechanism) -> ModelData:
    joints = tuple((joint.name, joint.rows, joint.unit) for joint in mechanism.joints)
    contacts = tuple((contact.name, *contact.too_deep()) for contact in mechanism.contacts)
    return {
        "bodies": _texts("BODIES", (body.name for body in mechanism.bodies)),
        "joints": Table("Joint", "JOINTS", joints),
        "contacts": Table("Contact", "CONTACTS", contacts),
        "patterns": _texts("PATTERNS", (pattern.name for pattern in mechanism.patterns)),
        "functions": _texts("FUNCTIONS", (function.name for function in mechanism.functions)),
        "rubs": _texts("RUBS", (part.name for part in mechanism.rubbing)),
        "elements": _texts("ELEMENTS", (element.name for element in mechanism.elements)),
        "unknowns": _texts("UNKNOWNS", unknown_names(mechanism)),
    }


def _texts(name: str, texts: Iterable[str]) -> Table:
    return Table("char *const", name, tuple((text,) for text in texts))


def _rule(rule: Rule) -> tuple[Cell, ...]:
    numbers = (rule.first, rule.rows, rule.columns, rule.stride, rule.integer, rule.holds.whole, rule.holds.nan)
    return rule.name, *map(int, numbers), float(rule.holds.low), float(rule.holds.high)


def _variable(variable: Variable) -> tuple[Cell, ...]:
    return (
        variable.name,
        "" if variable.unit in (None, "1") else f" {variable.unit}",
        _TYPES.index(variable.type),
        _CAUSALITIES.index(variable.causality),
        int(variable.variability == "continuous"),
        float(variable.start or 0.0),
        -math.inf if variable.minimum is None else float(variable.minimum),
        math.inf if variable.maximum is None else float(variable.maximum),
    )


def _again(again: Again) -> tuple[Cell, ...]:
    place = again.first.value_reference - FIRST_REFERENCE
    return again.name, place, again.count or 1, again.stride, int(again.clocked)
