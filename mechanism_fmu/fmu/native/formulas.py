"""Formulas of a model, and their C: from parameter values to tables in an instance's block, and to findings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields

import numpy as np

from ...model import GROUND, Mechanism, MechanismError, Settings
from ...model.beams import beam_members
from ...model.findings import MOST_NUMBERS, Finding, pieces
from ...model.functions import Number
from ...model.mechanism import curve_owners
from ...model.outline_contacts import numbered_outlines
from ...model.sources import reads_members
from ...model.structure import Structure, structure
from ...model.symbol import Operation, Symbol
from ...model.trace import Trace
from ...tables.declare import Array
from ...tables.layout import FIELDS, field_of, slot

# Which words of a block depend on parameters, and what they are called.


@dataclass(frozen=True)
class Entry:
    """A word of a block's tables that depends on a parameter.

    Attributes:
        word: its index in the block.
        label: for the user, its table and part, e.g. "inverse_mass of crank"; the name alone of a setting.
        value: what stands in the table.
    """

    word: int
    label: str
    value: Symbol


def entries(traced: Trace, block: Array) -> list[Entry]:
    """The words of a block that depend on a parameter, in the order of the block.

    Raises:
        MechanismError: the block is not one of the traced model.
    """
    found = []
    for field in FIELDS:
        if field.section != "tables":
            continue
        table = np.asarray(getattr(traced.tables, field.name))
        if table.shape != field_of(block, field.name).shape:
            raise MechanismError(
                f"The block is not one of {traced.model.name}: its table {field.name} has another size."
            )
        first = int(block.view(np.int64)[slot(field.name)])
        labels = _labels(field.name, traced.mechanism)
        for i, value in enumerate(table.flat):
            if isinstance(value, Symbol):
                found.append(Entry(first + i, labels[i * len(labels) // table.size], value))
    return found


def _labels(table: str, mechanism: Mechanism) -> list[str]:
    """One label a part: each has an equal share of the table."""
    if table == "settings":
        own = ("impact_law", "energy_guard", "tangential_shock", "through_singularities")
        return [*(setting.name for setting in fields(Settings)), *own]
    bodies = [body.name for body in mechanism.bodies]
    owners = curve_owners(mechanism)
    elastic = structure(mechanism) if reads_members(mechanism) else Structure()
    outlines = numbered_outlines(mechanism.contacts)
    parts = {
        "inverse": [*bodies, GROUND],
        "body": bodies,
        "joint": [joint.name for joint in mechanism.joints],
        "force": [force.name for force in mechanism.elements],
        "operation": [force.name for force in mechanism.elements for _ in force.operations()],
        "threshold": [force.name for force in mechanism.elements for _ in force.thresholds()],
        "contact": [contact.name for contact in mechanism.contacts],
        "feature": [owner for owner, chain in zip(outlines.owners, outlines.features, strict=True) for _ in chain],
        "outline": outlines.owners,
        "pattern": [pattern.name for pattern in mechanism.patterns],
        "function": [function.name for function in mechanism.functions],
        "curve": [name for name, _ in owners],
        "piece": [name for name, curve in owners for _ in curve.pieces],
        "term": [name for name, curve in owners for piece in curve.pieces for _ in piece.terms],
        "node": [body for body, _ in elastic.nodes],
        "member": [member.name for member in mechanism.members],
        "tie": [mechanism.joints[joint].name for joint, _ in elastic.ties],
        "couple": [mechanism.elements[force].name for force, _, _ in elastic.couples],
        "lump": [elastic.nodes[lump[0]][0] for lump in elastic.lumps],
        "locked": list(mechanism.held),
        "beam": [member.name for member in beam_members(mechanism)],
        "held": list(mechanism.held),
        "input": [port.name for port in mechanism.inputs],
        "output": [*(port.name for port in mechanism.outputs), *(port.name for port in mechanism.calculated)],
    }
    return [f"{table} of {part}" for part in parts[table.partition("_")[0]]]


_FORMS = {
    "add": "{} + {}",
    "subtract": "{} - {}",
    "multiply": "{} * {}",
    "divide": "{} / {}",
    "negate": "-{}",
    "sin": "mechanism_sin({})",
    "cos": "mechanism_cos({})",
    "tan": "mechanism_tan({})",
    "sqrt": "sqrt({})",
    "atan2": "mechanism_atan2({}, {})",
    "where_positive": "{} > 0.0 ? {} : {}",
}


@dataclass(frozen=True)
class Formulas:
    """A model's formulas, and what C must know to use them.

    Attributes:
        traced: what is calculated.
        values: what `words` get.
        numbers: of each objection, then of each warning and each problem, how far it applies (it does where that is
            > 0), and the numbers of its text.
        objections, warnings, problems: of each, its text for printf and the index of its `applies` in `findings`; its
            numbers follow there. Problems are to be said only where no objection applies.
        findings: length that the array `findings` must have. It is longer than what is written, so that
            `MOST_NUMBERS` numbers can be handed to printf behind every `applies`: set it to 0 first.
        words: of each word that is written, its index in `block` and its name for the user, e.g. "joint_data of pin".
    """

    traced: Trace
    values: tuple[Symbol, ...]
    numbers: tuple[Number, ...]
    objections: tuple[tuple[str, int], ...]
    warnings: tuple[tuple[str, int], ...]
    problems: tuple[tuple[str, int], ...]
    findings: int
    words: tuple[tuple[int, str], ...]

    @property
    def source(self) -> str:
        """C, with the one function `void mechanism_formulas(const double *p, double *block, double *findings)`.

        `p` holds the parameter values in the model's order; every word of `block`'s tables that depends on a parameter
        is written, no other; `findings` gets `numbers`. Nothing fails: what does not exist is not finite. Sine and its
        kin are those of the engine's object (engine.h). Compile it with -ffp-contract=off, or its numbers differ from
        Python's in the last bits.
        """
        return "\n".join(_source(self)) + "\n"


def formulas(traced: Trace, block: Array) -> Formulas:
    """The formulas of a traced model for a block of its structure, e.g. that of the default values."""
    written = entries(traced, block)
    findings = (*traced.objections, *traced.warnings, *traced.problems)
    numbers = [x for finding in findings for x in (finding.applies, *finding.numbers)]
    sizes = [1 + len(finding.numbers) for finding in findings]
    places = [int(place) for place in np.cumsum([0, *sizes[:-1]])] if sizes else []
    texts = [(printf_text(finding), place) for finding, place in zip(findings, places, strict=True)]
    warnings = len(traced.objections)
    problems = warnings + len(traced.warnings)
    return Formulas(
        traced=traced,
        values=tuple(entry.value for entry in written),
        numbers=tuple(numbers),
        objections=tuple(texts[:warnings]),
        warnings=tuple(texts[warnings:problems]),
        problems=tuple(texts[problems:]),
        findings=len(numbers) + MOST_NUMBERS,
        words=tuple((entry.word, entry.label) for entry in written),
    )


def printf_text(finding: Finding) -> str:
    """The text of a finding as a format of C's printf."""
    return "".join(plain.replace("%", "%%") + (f"%{form}" if form else "") for plain, form in pieces(finding.text))


def c_number(x: float) -> str:
    """A number as a C constant that is exactly it; it needs math.h."""
    if math.isnan(x):
        return "NAN"
    text = "INFINITY" if math.isinf(x) else abs(x).hex()
    return f"(-{text})" if math.copysign(1, x) < 0 else text


def _source(formulas: Formulas) -> Iterator[str]:
    traced = formulas.traced
    names: dict[int, str] = {}
    yield f"/* The formulas of {traced.model.name}; written by mechanism_fmu. */"
    yield "#include <math.h>"
    yield '#include "engine.h"'
    yield ""
    yield "void mechanism_formulas(const double *p, double *block, double *findings)"
    yield "{"
    yield "    (void)p; (void)block; (void)findings;"
    for number in traced.needed([*formulas.values, *formulas.numbers]):
        operation = traced.operations[number]
        if operation.name in ("parameter", "constant"):
            names[number] = _given(operation)
        else:
            form = _FORMS[operation.name].format(*(names[i] for i in operation.operands))
            names[number] = f"t{number}"
            yield f"    const double {names[number]} = {form};"
    for (word, _), value in zip(formulas.words, formulas.values, strict=True):
        yield f"    block[{word}] = {_name(value, names)};"
    for place, x in enumerate(formulas.numbers):
        yield f"    findings[{place}] = {_name(x, names)};"
    yield "}"


def _given(operation: Operation) -> str:
    return f"p[{int(operation.value)}]" if operation.name == "parameter" else c_number(operation.value)


def _name(x: Number, names: dict[int, str]) -> str:
    return names[x.number] if isinstance(x, Symbol) else c_number(float(x))
