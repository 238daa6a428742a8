"""Generated model.c: a model as constants for the C surface, and its formulas."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ...model import Mechanism, Model, compile_mechanism
from ...model.compile import unknown_names
from ...tables.layout import FIELDS, pack, slot
from ...tables.sizes import sizes_of
from ..instance.saved_state import Rule, rules
from ..parts.variables import FIRST_REFERENCE, Variable, variables_of
from .description3 import Again, outputs_again
from .formulas import Formulas, c_number
from .objects import advice_table, c_text

_CAUSALITIES = {"input": "INPUT", "output": "OUTPUT", "parameter": "PARAMETER", "calculatedParameter": "CALCULATED"}


def model_source(model: Model, formulas: Formulas, guid: str, mark: bytes, clocks: bool = False) -> str:
    """The text of model.c.

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
    members = {
        "name": c_text(model.name),
        "guid": c_text(guid),
        "mark": "{" + ", ".join(map(str, mark)) + "}",
        "variables": "VARIABLES",
        "variable_count": len(variables),
        "inputs": counts["input"],
        "outputs": counts["output"],
        "parameters": counts["parameter"],
        "has_clock": int(clocks),
        "again": "AGAIN",
        "again_count": len(again),
        "block": "(const double *)BLOCK",
        "given": given,
        "words": len(block),
        "numbers": formulas.findings,
        "objections": "OBJECTIONS",
        "problems": "PROBLEMS",
        "warnings": "WARNINGS",
        "objection_count": len(formulas.objections),
        "problem_count": len(formulas.problems),
        "warning_count": len(formulas.warnings),
        "dependent": "DEPENDENT",
        "dependent_count": len(formulas.words),
        "bodies": "BODIES",
        "joints": "JOINTS",
        "contacts": "CONTACTS",
        "patterns": "PATTERNS",
        "functions": "FUNCTIONS",
        "unknowns": "UNKNOWNS",
        "rules": "RULES",
        "rule_count": len(held),
    }
    return "\n".join(
        [
            f"/* {model.name}: written by model_data.py. */",
            '#include "engine.h"',
            '#include "model.h"',
            "#include <math.h>",
            advice_table(),
            _array("Variable", "VARIABLES", map(_variable, variables)),
            _array("Again", "AGAIN", map(_again, again)),
            _array("uint64_t", "BLOCK", (f"{word:#x}" for word in block[:given].view("uint64").tolist())),
            _array("Finding", "OBJECTIONS", (f"{{{c_text(text)}, {at}}}" for text, at in formulas.objections)),
            _array("Finding", "PROBLEMS", (f"{{{c_text(text)}, {at}}}" for text, at in formulas.problems)),
            _array("Finding", "WARNINGS", (f"{{{c_text(text)}, {at}}}" for text, at in formulas.warnings)),
            _array("Word", "DEPENDENT", (f"{{{word}, {c_text(label)}}}" for word, label in formulas.words)),
            *_names(mechanism),
            _array("Rule", "RULES", map(_rule, held)),
            "const Model model = {",
            *(f"    .{name} = {value}," for name, value in members.items()),
            "};",
            formulas.source,
        ]
    )


def _array(kind: str, name: str, entries: Iterable[str]) -> str:
    """An array constant; one without entries gets an empty one, because C has no arrays of length 0."""
    text = ",\n    ".join(entries)
    return f"static const {kind} {name}[] = {{\n    {text or 0}\n}};"


def _names(mechanism: Mechanism) -> list[str]:
    joints = (f"{{{c_text(joint.name)}, {joint.rows}, {c_text(joint.unit)}}}" for joint in mechanism.joints)
    contacts = (f"{{{', '.join(map(c_text, (c.name, *c.too_deep())))}}}" for c in mechanism.contacts)
    return [
        _array("char *const", "BODIES", (c_text(body.name) for body in mechanism.bodies)),
        _array("Joint", "JOINTS", joints),
        _array("Contact", "CONTACTS", contacts),
        _array("char *const", "PATTERNS", (c_text(pattern.name) for pattern in mechanism.patterns)),
        _array("char *const", "FUNCTIONS", (c_text(function.name) for function in mechanism.functions)),
        _array("char *const", "UNKNOWNS", map(c_text, unknown_names(mechanism))),
    ]


def _rule(rule: Rule) -> str:
    numbers = (rule.first, rule.rows, rule.columns, rule.stride, rule.integer, rule.holds.whole, rule.holds.nan)
    limits = (c_number(float(rule.holds.low)), c_number(float(rule.holds.high)))
    return f"{{{', '.join((c_text(rule.name), *(str(int(number)) for number in numbers), *limits))}}}"


def _variable(variable: Variable) -> str:
    unit = "" if variable.unit in (None, "1") else f" {variable.unit}"
    numbers = (
        float(variable.start or 0.0),
        -math.inf if variable.minimum is None else variable.minimum,
        math.inf if variable.maximum is None else variable.maximum,
    )
    entries: Sequence[str] = (
        c_text(variable.name),
        c_text(unit),
        variable.type.upper(),
        _CAUSALITIES[variable.causality],
        str(int(variable.variability == "continuous")),
        *(c_number(float(number)) for number in numbers),
    )
    return f"{{{', '.join(entries)}}}"


def _again(again: Again) -> str:
    place = again.first.value_reference - FIRST_REFERENCE
    numbers = (place, again.count or 1, again.stride, int(again.clocked))
    return f"{{{', '.join((c_text(again.name), *map(str, numbers)))}}}"
