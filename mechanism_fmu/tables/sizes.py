"""Sizes of all tables, and where the parts of y begin: the first words of a block."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple, Self, cast

import numpy as np

from .. import codes
from .declare import Array

#: A mechanism with more bodies has no room for a full Jacobian, and no linearly implicit steps.
MOST_IMPLICIT = 115


class _Size(NamedTuple):
    """A size; `rule` calculates it from those before it, or is None for one that is given."""

    rule: Callable[[Mapping[str, int]], int] | None


def _given() -> int:
    return cast(int, _Size(None))


def _follows(rule: Callable[[Mapping[str, int]], int]) -> int:
    return cast(int, _Size(rule))


class Sizes:
    """How many of each there are, in the order of the header."""

    bodies = _given()
    joints = _given()
    forces = _given()
    contacts = _given()
    patterns = _given()
    functions = _given()
    curves = _given()
    pieces = _given()
    terms = _given()
    features = _given()  # of outlines
    outlines = _given()
    alphas = _given()  # contact coordinates
    own = _given()  # states of force elements' own
    oscillations = _given()  # the last force elements
    wears = _given()  # contacts whose work of sliding is added up
    operations = _given()  # of laws of force
    thresholds = _given()  # of force elements
    held = _given()
    inputs = _given()
    outputs = _given()
    members = _given()  # elastic ones; these seven are zero when no output asks for them
    nodes = _given()
    ties = _given()
    lumps = _given()
    couples = _given()
    locked = _given()
    beams = _given()
    rubs = _given()  # contacts, joints and force elements, where any may rub; else 0
    joint_rows = _given()
    contact_rows = _given()  # of all contacts, when contact coordinates count as coordinates
    coordinates = _follows(lambda n: 3 * n["bodies"])
    columns = _follows(lambda n: n["coordinates"] + 3)  # and those of the ground
    wide = _follows(lambda n: n["columns"] + n["alphas"])
    frames = _follows(lambda n: n["bodies"] + 1)  # and the ground
    rows = _follows(lambda n: n["joint_rows"] + n["contact_rows"] + n["rubs"] + 1)  # and a spare one
    squared_rows = _follows(lambda n: n["rows"] ** 2)
    # y = (q, qd, work, loss, alpha, own, wear): positions begin at 0, rates at `coordinates`, the others here
    y_work = _follows(lambda n: 2 * n["coordinates"])
    y_loss = _follows(lambda n: n["y_work"] + 1)
    y_alpha = _follows(lambda n: n["y_loss"] + 1)
    y_own = _follows(lambda n: n["y_alpha"] + n["alphas"])
    y_wear = _follows(lambda n: n["y_own"] + n["own"])  # from here on, accuracy of the steps is not asked
    unknowns = _follows(lambda n: n["y_wear"] + n["wears"])
    # for linearly implicit steps: unknowns, and those of the linear system, the rates, contact coordinates, own states
    implicit = _follows(lambda n: n["unknowns"] if n["bodies"] <= MOST_IMPLICIT else 0)
    may_be_implicit = _follows(lambda n: min(n["implicit"], 1))
    implicit_rates = _follows(lambda n: n["coordinates"] + n["y_wear"] - n["y_alpha"] if n["implicit"] > 0 else 0)
    # two a contact, two a pattern, one a logical function, one for each friction
    guards = _follows(lambda n: 2 * n["contacts"] + 2 * n["patterns"] + n["functions"] + n["rubs"])
    # of Model Exchange: one for each guard, one for each threshold, and one for how far the bodies have turned
    indicators = _follows(lambda n: n["guards"] + n["thresholds"] + 1)
    # what directional derivatives are of: outputs, and derivatives of the states
    responses = _follows(lambda n: n["outputs"] + n["unknowns"])
    rub_columns = _follows(lambda n: n["rubs"] + 1)
    # unknowns of the complementarity problem of contacts with friction, and columns of its tableau
    problem = _follows(lambda n: 4 * n["contacts"] if n["rubs"] > 0 else 0)
    problem_columns = _follows(lambda n: 2 * n["problem"] + 2)
    # columns of an impact record
    record = _follows(lambda n: codes.RECORD_CONTACT_IMPULSES + n["contacts"] + 2 * n["coordinates"])
    # columns of an event record: the modes of many contacts take several numbers
    event = _follows(lambda n: codes.EVENT_COLUMNS + 2 * (max(n["contacts"] - 1, 0) // codes.MODE_BITS))
    buffer = _given()  # impacts that are kept of one communication step
    event_buffer = _given()  # and events
    displacements = _follows(lambda n: 3 * n["nodes"])

    def __new__(cls, block: Array) -> Self:
        """The sizes of a block."""
        view = super().__new__(cls)
        view.__dict__.update(sizes_of(block))
        return view


_RULES = {name: size.rule for name, size in vars(Sizes).items() if isinstance(size, _Size)}
#: Names of the sizes, in the order of the header.
SIZES = tuple(_RULES)
#: Those that `layout.allocate` is given; the others follow.
GIVEN_SIZES = tuple(name for name, rule in _RULES.items() if rule is None)


def complete(given: Mapping[str, int]) -> dict[str, int]:
    """All sizes, from those of `GIVEN_SIZES`."""
    sizes = dict(given)
    for name, rule in _RULES.items():
        if rule is not None:
            sizes[name] = rule(sizes)
    return {name: sizes[name] for name in SIZES}


def sizes_of(block: Array) -> dict[str, int]:
    """The sizes in a block's header, by name, in the order of `SIZES`."""
    return dict(zip(SIZES, block[: len(SIZES)].view(np.int64).tolist(), strict=True))
