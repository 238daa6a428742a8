"""`engine.c`: compiled by the system's C compiler, called by ctypes, its structs filled from the engine's tables."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
from ctypes import POINTER, Structure, c_double, c_int, c_int64, c_size_t, c_void_p
from pathlib import Path
from typing import Any

import numpy as np

from mechanism_fmu import codes
from mechanism_fmu.tables.kinds import FORCES, JOINTS
from mechanism_fmu.tables.layout import field_of
from mechanism_fmu.tables.sizes import sizes_of

Array = np.ndarray[Any, np.dtype[Any]]

#: For this very processor, as the engine is compiled. No fast-math and no fused operations: numbers are rounded alike.
_OPTIONS = ("-std=c11", "-O3", "-march=native", "-ffp-contract=off", "-fPIC", "-shared")

#: Communication step [s].
STEP = 1e-3

# As in engine.c.
_MAX_PINS, _MAX_FORCES, _MAX_CONTACTS, _MAX_INPUTS, _MAX_COLUMNS = 5, 8, 4, 8, 16
#: What `export` reads.
_TABLES = (
    *("inverse_mass", "inverse_root_mass", "settings", "input_force", "input_column"),
    *("input_factor", "input_offset"),
    *("joint_kind", "joint_body_i", "joint_body_j", "joint_data", "joint_friction"),
    *("force_kind", "force_body", "force_reaction", "force_data"),
    *("contact_kind", "contact_body_i", "contact_body_j", "contact_data", "contact_value", "contact_line"),
    *("contact_function", "pattern_enabled"),
)
_KINDS = {FORCES.number(kind): k for k, kind in enumerate(("torque", "torsion_spring", "damper", "shaft"))}


class NoCompilerError(RuntimeError):
    """There is no C compiler here."""


class _Pin(Structure):
    _fields_ = (("i", c_int), ("j", c_int), ("point_i", c_double * 2), ("point_j", c_double * 2))


class _Force(Structure):
    _fields_ = (("kind", c_int), ("body", c_int), ("reaction", c_int), ("data", c_double * 4))


class _Contact(Structure):
    _fields_ = (
        ("i", c_int),
        ("j", c_int),
        ("guided", c_int),
        ("point", c_double * 2),
        ("line", c_double * 4),
        ("restitution", c_double),
    )


class _Input(Structure):
    _fields_ = (("force", c_int), ("column", c_int))


class Mechanism(Structure):
    """The struct `Mechanism` of engine.c."""

    _fields_ = (
        *((name, c_int) for name in ("bodies", "pins", "forces", "contacts", "inputs")),
        ("inverse_mass", c_double * _MAX_COLUMNS),
        ("inverse_root_mass", c_double * _MAX_COLUMNS),
        ("pin", _Pin * _MAX_PINS),
        ("force", _Force * _MAX_FORCES),
        ("contact", _Contact * _MAX_CONTACTS),
        ("input", _Input * _MAX_INPUTS),
        *((name, c_double) for name in ("relative_tolerance", "alpha", "beta")),
    )


def build(folder: Path) -> ctypes.CDLL:
    """Compile engine.c into `folder` and load it.

    Raises:
        NoCompilerError: there is no program `cc`, nor what the variable CC names.
        RuntimeError: the compiler cannot compile it.
    """
    command = os.environ.get("CC", "cc").split()
    if not command or shutil.which(command[0]) is None:
        raise NoCompilerError("There is no C compiler (cc, or what the variable CC names).")
    target = folder / "c_limit.so"
    source = Path(__file__).with_name("engine.c")
    done = subprocess.run([*command, *_OPTIONS, str(source), "-o", str(target), "-lm"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{source.name} cannot be compiled by {' '.join(command)}:\n{done.stderr}")
    library = ctypes.CDLL(str(target))
    library.engine_size.restype = library.engine_state_size.restype = library.engine_mechanism_size.restype = c_size_t
    library.engine_state.restype = c_void_p
    library.engine_state.argtypes = library.engine_steps.argtypes = library.engine_impact_time.argtypes = [c_void_p]
    library.engine_impact_time.restype = c_double
    library.engine_begin.argtypes = [c_void_p, POINTER(Mechanism), c_void_p, c_void_p]
    library.engine_begin.restype = library.engine_read.restype = library.engine_derivatives.restype = None
    library.engine_run.argtypes = [c_void_p, c_void_p, c_double, c_int, c_int]
    library.other_run.argtypes = [c_void_p, c_void_p, c_int64, c_int64, c_void_p, c_double, c_int, c_int]
    library.engine_read.argtypes = [c_void_p, c_void_p]
    library.engine_derivatives.argtypes = [c_void_p, c_void_p, c_void_p, c_int]
    return library


class Limit:
    """An instance of the C program, which begins where an engine's block stands: assembled, at rest, at time 0."""

    def __init__(self, library: ctypes.CDLL, block: Array) -> None:
        mechanism = export(block)
        if library.engine_mechanism_size() != ctypes.sizeof(Mechanism):
            raise RuntimeError("The structs of library.py and engine.c differ.")
        self._library = library
        self._memory = ctypes.create_string_buffer(library.engine_size())
        self.address = ctypes.addressof(self._memory)
        closed = [int(field_of(block, "contact_mode")[c]) for c in enabled_contacts(block)]
        self._unknowns = sizes_of(block)["unknowns"]
        position = field_of(block, "y_end")[: sizes_of(block)["coordinates"]].copy()
        library.engine_begin(
            self.address, ctypes.byref(mechanism), position.ctypes.data, (c_int * len(closed))(*closed)
        )

    @property
    def steps(self) -> int:
        """How many steps of its own it has accepted."""
        return int(self._library.engine_steps(self.address))

    @property
    def impact_time(self) -> float:
        """Time of the last impact [s]; 0 before the first."""
        return float(self._library.engine_impact_time(self.address))

    def run(self, torques: Array, first: int, count: int) -> None:
        """Make `count` communication steps, from number `first` on, with two drive torques in turns.

        Raises:
            RuntimeError: the motion cannot go on.
        """
        outcome = self._library.engine_run(self.address, torques.ctypes.data, STEP, first, count)
        if outcome:
            raise RuntimeError(f"engine.c ends with status {outcome}.")

    def unknowns(self) -> Array:
        """Y = (q, qd, work, loss) at the time reached."""
        y = np.empty(self._unknowns)
        self._library.engine_read(self.address, y.ctypes.data)
        return y

    def derivatives(self, y: Array, dy: Array, count: int) -> None:
        """Evaluate the derivative of `y` `count` times, into `dy`."""
        self._library.engine_derivatives(self.address, y.ctypes.data, dy.ctypes.data, count)

    def save(self) -> bytes:
        """The whole state."""
        return ctypes.string_at(self._library.engine_state(self.address), self._library.engine_state_size())

    def restore(self, state: bytes) -> None:
        """Return to a saved state."""
        ctypes.memmove(self._library.engine_state(self.address), state, len(state))


def export(block: Array) -> Mechanism:
    """The mechanism in an engine's block, as far as it is enabled.

    Raises:
        ValueError: it has what engine.c has not.
    """
    size = sizes_of(block)
    of = {name: field_of(block, name).tolist() for name in _TABLES}
    enabled = enabled_contacts(block)
    for what, reason in _objections(of, enabled).items():
        if reason:
            raise ValueError(f"The C program knows no {what}: give it the guided ratchet.")
    result = Mechanism(
        size["bodies"],
        size["joints"],
        size["forces"],
        len(enabled),
        size["inputs"],
        (c_double * _MAX_COLUMNS)(*of["inverse_mass"]),
        (c_double * _MAX_COLUMNS)(*of["inverse_root_mass"]),
    )
    for k, (i, j, data) in enumerate(zip(of["joint_body_i"], of["joint_body_j"], of["joint_data"], strict=True)):
        result.pin[k] = _Pin(i, j, (c_double * 2)(*data[:2]), (c_double * 2)(*data[2:4]))
    forces = zip(of["force_kind"], of["force_body"], of["force_reaction"], of["force_data"], strict=True)
    for k, (kind, body, reaction, data) in enumerate(forces):
        result.force[k] = _Force(_KINDS[kind], body, reaction, (c_double * 4)(*data[:4]))
    for k, c in enumerate(enabled):
        value = of["contact_value"][c]
        result.contact[k] = _Contact(
            of["contact_body_i"][c],
            of["contact_body_j"][c],
            int(value[codes.GUIDED]),
            (c_double * 2)(*of["contact_data"][c][:2]),
            (c_double * 4)(*of["contact_line"][c]),
            value[codes.RESTITUTION],
        )
    for k, (force, column) in enumerate(zip(of["input_force"], of["input_column"], strict=True)):
        result.input[k] = _Input(force, column)
    result.relative_tolerance, result.alpha, result.beta = of["settings"][:3]
    return result


def _objections(of: dict[str, Any], enabled: list[int]) -> dict[str, bool]:
    """What engine.c does not know, and whether it is there."""
    return {
        "sliders": any(kind != JOINTS.number("revolute") for kind in of["joint_kind"]),
        "friction": any(of["joint_friction"]) or any(of["contact_value"][c][codes.FRICTION] for c in enabled),
        "forces other than torques": any(kind not in _KINDS for kind in of["force_kind"]),
        "free contacts": any(of["contact_value"][c][codes.GUIDED] < 0.5 for c in enabled),
        "stops": any(of["contact_kind"][c] != codes.POINT_LINE for c in enabled),
        "logical functions": any(of["contact_function"][c] != codes.NONE for c in enabled),
        "patterns": any(of["pattern_enabled"]),
        "inputs that are transformed": any(of["input_offset"]) or any(factor != 1.0 for factor in of["input_factor"]),
    }


def enabled_contacts(block: Array) -> list[int]:
    """The contacts that the C program is given."""
    return [c for c, value in enumerate(field_of(block, "contact_value")) if value[codes.ENABLED] > 0.5]
