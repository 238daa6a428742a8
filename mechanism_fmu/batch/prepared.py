"""What is the same for all designs of a model."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .. import codes
from ..fmu.native.entries import Entry, entries
from ..model import Mechanism, Model, compile_mechanism
from ..model.trace import Trace, trace
from ..tables.layout import field_of, slot
from ..tables.pack import pack
from .numbers import Array

_FIRST_IMPACT = re.compile(r"impacts\[1\]\.(.+)")


@dataclass(frozen=True)
class Prepared:
    """A model's structure, and how its tables follow from parameters.

    Attributes:
        traced: from parameters to tables.
        mechanism: with the default values.
        given: its block before the first call, shape (words,).
        entries: the words of it that depend on a parameter.
        inputs: the word of each input, by name.
        outputs: the number of each output and calculated parameter, by name.
        impact_fields: the column of an impact record of each `impacts[1].<field>`, by field.
    """

    traced: Trace
    mechanism: Mechanism
    given: Array
    entries: tuple[Entry, ...]
    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    impact_fields: Mapping[str, int]


def prepared(model: Model) -> Prepared:
    """Make a model ready.

    Raises:
        MechanismError: its default values are refused, or it cannot be traced.
    """
    mechanism = model.build(model.values())
    block = pack(compile_mechanism(mechanism))
    traced = trace(model)
    first_input = int(block.view("int64")[slot("inputs")])
    names = [*(output.name for output in mechanism.outputs), *(value.name for value in mechanism.calculated)]
    outputs = {name: k for k, name in enumerate(names)}
    kinds, columns = (field_of(block, name).tolist() for name in ("output_kind", "output_index"))
    fields = {}
    for name, k in outputs.items():
        found = _FIRST_IMPACT.fullmatch(name)
        if found and kinds[k] == codes.BUFFERED_IMPACT:
            fields[found[1]] = columns[k]
    return Prepared(
        traced,
        mechanism,
        block,
        tuple(entries(traced, block)),
        {port.name: first_input + k for k, port in enumerate(mechanism.inputs)},
        outputs,
        fields,
    )
