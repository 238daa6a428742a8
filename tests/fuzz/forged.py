"""The kept forged states (corpus.toml) for a model."""

from __future__ import annotations

import struct
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path

from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.fmu.instance.saved_state import rules
from mechanism_fmu.model import Model, compile_mechanism
from mechanism_fmu.tables.layout import pack
from mechanism_fmu.tables.sizes import sizes_of

#: Words of the head of a native state, as in instance_data.h.
HEAD = ("phase", "set_up", "prepared", "start_time", "stop_time", "tolerance", "clock", "left", "exchange", "updated")
_CORPUS = tomllib.loads(Path(__file__).with_name("corpus.toml").read_text(encoding="utf-8"))


def forged_words(model: Model) -> Iterator[tuple[str, int, int]]:
    """Name, place in the engine's state and bits of every kept word that this model has."""
    sizes = sizes_of(pack(compile_mechanism(model.build(model.values()))))
    of_model = rules(sizes)
    known = {rule.name: rule for rule in of_model}
    for entry in _CORPUS["state"]:
        rule = known[entry["word"]]
        if rule.rows * rule.columns > 0:
            for value in entry["holds"]:
                if rule.name == "counters[PENDING_GUARD]" and value == codes.GUARD_FAILED and _may_fail(sizes):
                    continue
                yield f"{rule.name} = {value}", rule.first, _bits(value)


def _may_fail(sizes: Mapping[str, int]) -> bool:
    """Whether a contact has the number of a failure: its event, forged to a failed one, is one as any other."""
    return sizes["contacts"] > min(status.EVENT_FAILURES)


def forged_heads() -> Iterator[tuple[str, int, int]]:
    """The same of the head of a native state."""
    for entry in _CORPUS["head"]:
        for value in entry["holds"]:
            yield f"{entry['word']} = {value}", HEAD.index(entry["word"]), _bits(value)


def _bits(value: float) -> int:
    form = "<q" if isinstance(value, int) else "<d"
    (bits,) = struct.unpack("<Q", struct.pack(form, value))
    return int(bits)
