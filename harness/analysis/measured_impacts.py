"""Measured impacts of a body in the plane, at one point: their table, errors of predictions, the best rigid impulse."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..errors import UsageError
from .impact_laws import Array, Contact, Impulse

#: The columns that are needed, by what they make.
BEFORE = ("vx_before", "vy_before", "omega_before")
AFTER = ("vx_after", "vy_after", "omega_after")
PLACE = ("r_x", "r_y", "n_x", "n_y", "radius_of_gyration")
COLUMNS = (*BEFORE, *AFTER, *PLACE)
#: Marks of doubtful rows, one digit each; only needed to leave them out.
FLAGS = "flags"
#: No velocity [m/s, rad/s] and no length [m] is larger, no radius of gyration smaller than its inverse: it is a slip of
#: units or of the pen, and squares of more would overflow.
_LARGEST = 1e6
#: How long a normal may be beside 1: rounding to some digits.
_UNIT = 1e-3


@dataclass(frozen=True)
class Impacts:
    """Impacts, one a row, velocities scaled so that v . v is twice the kinetic energy of unit mass.

    Attributes:
        before, after: (vx, vy, k omega) [m/s], k: radius of gyration, shape (rows, 3).
        normal, tangent: what an impulse of unit mass at the contact does to these [1], J M^-1/2, shape (rows, 3).
    """

    before: Array
    after: Array
    normal: Array
    tangent: Array

    def __len__(self) -> int:
        """How many there are."""
        return len(self.before)

    def part(self, rows: slice | npt.NDArray[np.bool_]) -> Impacts:
        """Some of them.

        Args:
            rows: which, as an index or a mask of shape (rows,).
        """
        return Impacts(self.before[rows], self.after[rows], self.normal[rows], self.tangent[rows])

    @cached_property
    def contact(self) -> Contact:
        """What the laws need, each of shape (rows,)."""
        n, t, v = self.normal, self.tangent, self.before
        pairs = ((n, n), (n, t), (t, t), (n, v), (t, v))
        return Contact(*(np.einsum("ij,ij->i", a, b) for a, b in pairs))

    @cached_property
    def _in_numbers(self) -> tuple[Array, Array, Array, Array]:
        """Of the jump of the velocity: its square, its products with normal and tangent, and |after|."""
        jump = self.after - self.before
        products = (np.einsum("ij,ij->i", jump, other) for other in (jump, self.normal, self.tangent))
        square, n, t = products
        return square, n, t, np.linalg.norm(self.after, axis=1)

    def errors(self, impulse: Impulse) -> Array:
        """|v_predicted - v_measured| / |v_measured| in the norm of the kinetic energy [1].

        Args:
            impulse: normal and tangential, of unit mass [m/s], shape (rows,) or (rows, cells).
        """
        p_n, p_t = impulse
        shape = (-1,) + (1,) * (np.ndim(p_n) - 1)
        g_nn, g_nt, g_tt = (g.reshape(shape) for g in self.contact[:3])
        square, n, t, size = (part.reshape(shape) for part in self._in_numbers)
        # (G P - jump)^2 written out, so that no array has a third axis
        left = square + p_n * (g_nn * p_n + 2.0 * (g_nt * p_t - n)) + p_t * (g_tt * p_t - 2.0 * t)
        return np.sqrt(np.maximum(left, 0.0)) / size

    def best_impulse(self) -> Impulse:
        """The impulse at the contact that comes nearest to what was measured, by no law; shapes (rows,)."""
        g_nn, g_nt, g_tt = self.contact[:3]
        _, n, t, _ = self._in_numbers
        determinant = g_nn * g_tt - g_nt * g_nt
        return (g_tt * n - g_nt * t) / determinant, (g_nn * t - g_nt * n) / determinant


def impacts_of(before: Array, after: Array, place: Array, normal: Array, radius: Array) -> Impacts:
    """Impacts by what is measured.

    Args:
        before: (vx, vy, omega) before the impact [m/s, m/s, rad/s], shape (rows, 3).
        after: the same after it.
        place: contact point minus centre of mass [m], shape (rows, 2).
        normal: unit vector into the body [1], shape (rows, 2).
        radius: of gyration [m], shape (rows,).
    """
    scale = np.column_stack([np.ones_like(radius), np.ones_like(radius), radius])

    def along(d_x: Array, d_y: Array) -> Array:
        return np.column_stack([d_x, d_y, (place[:, 0] * d_y - place[:, 1] * d_x) / radius])

    n_x, n_y = normal.T
    return Impacts(before * scale, after * scale, along(n_x, n_y), along(n_y, -n_x))


def read_impacts(path: Path, unflagged: bool = False) -> Impacts:
    """Read a table of impacts.

    Lines that begin with # are comments. The first other line names the columns, in any order; what is not in `COLUMNS`
    is left alone.

    Args:
        path: of a CSV file.
        unflagged: whether rows with a 1 in the column `flags` are left out.

    Raises:
        UsageError: the file, a column or a number cannot be used; the message names the line.
    """
    lines = list(_lines(path))
    if not lines:
        raise UsageError(
            f"{path}: there is nothing in it; it needs a line of headings ({', '.join(COLUMNS)}) and rows."
        )
    (line, header), rows = lines[0], lines[1:]
    header = [name.strip() for name in header]
    wanted = (*COLUMNS, FLAGS) if unflagged else COLUMNS
    _check_header(path, line, header, wanted)
    for line, cells in rows:
        if len(cells) != len(header):
            raise UsageError(f"{path}, line {line}: has {len(cells)} values, but there are {len(header)} headings.")
    if unflagged:
        place = header.index(FLAGS)
        rows = [row for row in rows if "1" not in row[1][place]]
    if not rows:
        raise UsageError(f"{path}: has headings, but no impact{' without a flag' if unflagged else ''}; add rows.")
    values = {name: _numbers(path, rows, header.index(name), name) for name in COLUMNS}
    numbers = [line for line, _ in rows]
    return _checked(path, numbers, values)


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """The lines that are no comments and not empty, with their numbers.

    Raises:
        UsageError: it cannot be read.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"The file of impacts '{path}' cannot be read: {error}.") from error
    for number, line in enumerate(io.StringIO(text), start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            try:
                yield number, next(csv.reader([line.strip()]))
            except csv.Error as error:
                raise UsageError(f"{path}, line {number}: cannot be read: {error}.") from error


def _check_header(path: Path, line: int, header: Sequence[str], wanted: Sequence[str]) -> None:
    missing = [name for name in wanted if name not in header]
    if missing:
        joined = " Columns are joined by commas." if len(header) == 1 else ""
        raise UsageError(
            f"{path}, line {line}: there is no column {', '.join(missing)}; needed are {', '.join(wanted)}.{joined}"
        )
    twice = [name for name in wanted if header.count(name) > 1]
    if twice:
        raise UsageError(f"{path}, line {line}: the column '{twice[0]}' is there twice; keep one.")


def _numbers(path: Path, rows: Sequence[tuple[int, list[str]]], column: int, name: str) -> Array:
    found = []
    for line, cells in rows:
        try:
            number = float(cells[column])
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise UsageError(f"{path}, line {line}: {name} = '{cells[column].strip()}' is not a finite number.")
        if abs(number) > _LARGEST:
            raise UsageError(f"{path}, line {line}: {name} = {number:g} is beyond {_LARGEST:g}; give SI units.")
        found.append(number)
    return np.array(found)


def _checked(path: Path, lines: Sequence[int], values: dict[str, Array]) -> Impacts:
    """The impacts, of which each can be one.

    Raises:
        UsageError: naming the first line that cannot.
    """

    def refuse(wrong: npt.NDArray[np.bool_], name: str, numbers: Array, advice: str) -> None:
        if bool(np.any(wrong)):
            first = int(np.argmax(wrong))
            raise UsageError(f"{path}, line {lines[first]}: {name} = {numbers[first]:g} {advice}")

    def columns(names: Sequence[str]) -> Array:
        return np.column_stack([values[name] for name in names])

    radius, normal = values["radius_of_gyration"], columns(("n_x", "n_y"))
    refuse(radius < 1.0 / _LARGEST, "radius_of_gyration", radius, f"m must be at least {1.0 / _LARGEST:g}.")
    length = np.hypot(*normal.T)
    refuse(np.abs(length - 1.0) > _UNIT, "the length of (n_x, n_y)", length, "must be 1: give a unit normal.")
    place = columns(("r_x", "r_y"))
    impacts = impacts_of(columns(BEFORE), columns(AFTER), place, normal / length[:, None], radius)
    closing = impacts.contact.v_n
    advice = "m/s must be negative: the contact does not approach. The normal points into the body that moves."
    refuse(~(closing < 0.0), "the normal velocity before", closing, advice)
    size = np.linalg.norm(impacts.after, axis=1)
    refuse(size == 0.0, "the speed after", size, "m/s leaves nothing to compare with; leave the row out.")
    return impacts
