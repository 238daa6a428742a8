"""Value access of an FMU: variables grouped into one FMI call for each type, and Real ones that are bound once."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Mapping, MutableSequence, Sequence
from ctypes import Array, c_double, c_int, c_size_t, c_uint, c_void_p
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol

from ...errors import FmuError, LogMessage, Status, UsageError
from ..description import Description, Value

# Which calls get or set some variables of an FMU: one for each type.


@dataclass
class Batch:
    """Variables of one type.

    Attributes:
        kind: name of the type in the functions of FMI.
        type: what it is to the harness.
        references: value references, each once.
        count: numbers that belong to them: more than references where there are arrays.
        places: of the variables among those that are asked for.
        offsets: of the variables among the numbers.
        bound: an instance's own way of getting them fast; None until it has one.
    """

    kind: str
    type: str
    references: list[int] = field(default_factory=list)
    count: int = 0
    places: list[int] = field(default_factory=list)
    offsets: list[int] = field(default_factory=list)
    bound: Any = None

    @property
    def is_whole(self) -> bool:
        """Whether all numbers are asked for; else there are arrays of which only some elements are."""
        return self.count == len(set(self.offsets))


def batches(names: Sequence[str], description: Description) -> list[Batch]:
    """The calls for variables by name."""
    found: dict[str, Batch] = {}
    begins: dict[tuple[str, int], int] = {}
    for place, name in enumerate(names):
        variable = description.variable(name)
        batch = found.setdefault(variable.fmi_type, Batch(variable.fmi_type, variable.type))
        key = variable.fmi_type, variable.reference
        if key not in begins:
            begins[key] = batch.count
            batch.references.append(variable.reference)
            batch.count += variable.elements
        batch.places.append(place)
        batch.offsets.append(begins[key] + variable.element)
    return list(found.values())


#: From what fmpy returns for a variable, by its type.
FROM_C: dict[str, Callable[[Any], Value]] = {
    "Real": float,
    "Integer": int,
    "Boolean": bool,
    "String": lambda raw: raw if isinstance(raw, str) else (raw or b"").decode("utf-8"),
    "Binary": lambda raw: (raw or b"").hex(),
}


# Real variables of an FMU, bound once: their numbers lie in arrays that the FMU reads and fills itself.

#: Statuses beyond it are refusals; a plain number, which is compared fast.
_WARNING = int(Status.WARNING)


class Owner(Protocol):
    """The instance whose variables they are."""

    name: str
    description: Description

    @property
    def messages(self) -> list[LogMessage]:
        """What it has said so far."""

    def refusal(self, function: str, status: int, said: int) -> FmuError:
        """What to raise for a refused call."""

    def failure(self, function: str, reason: str) -> FmuError:
        """What to raise for an answer that cannot be used."""

    def quietly(self, call: Callable[[], int]) -> int:
        """Call a function without showing what it says."""

    def raw(self, name: str) -> Callable[..., int]:
        """A function of the library."""


@dataclass(frozen=True)
class Call:
    """A function of the FMU with all of its arguments, and its name for messages."""

    name: str
    function: Callable[[], int]


#: The same numbers as Python's array, which is summed fast, and as one of C, which is filled fast.
Numbers = tuple["array[float]", "Array[c_double]"]


def doubles(count: int) -> Numbers:
    """So many numbers."""
    numbers = array("d", bytes(8 * count))
    return numbers, (c_double * count).from_buffer(numbers)


def nothing() -> int:
    """Nothing is asked for: no call."""
    return int(Status.OK)


def no_slopes(instance: str, names: Sequence[str]) -> UsageError:
    """What to raise for slopes of inputs where `Description.takes_slopes` says that there are none."""
    return UsageError(
        f"{instance} takes no slopes of inputs, here of {', '.join(names)}: FMUs of FMI 3.0 do not, nor those of "
        "FMI 2.0 without canInterpolateInputs. Write values before each step instead."
    )


class RawReals:
    """Variables of an instance (a `machine.component.Reals`).

    Attributes:
        values: what `read` found and `write` takes.
    """

    def __init__(
        self,
        owner: Owner,
        names: Sequence[str],
        numbers: Numbers,
        calls: tuple[Call, Call, Call | None, Call | None],
    ) -> None:
        """Bind variables.

        Args:
            owner: the instance.
            names: of the variables.
            numbers: theirs, from `doubles`, to which all calls are bound.
            calls: those that get, set, get derivatives of outputs, and set those of inputs.
        """
        self._owner = owner
        self._messages = owner.messages
        self._names = tuple(names)
        self._numbers = numbers[0]
        self.values: MutableSequence[float] = numbers[1]  # type: ignore[assignment]
        get, put, get_slopes, put_slopes = calls
        self._get, self._put, self._get_slopes, self._put_slopes = get, put, get_slopes, put_slopes
        self._getter, self._putter = get.function, put.function

    def read(self) -> None:
        """Fill `values` with those of now.

        Raises:
            FmuError: the FMU refuses, or a value is not finite.
        """
        said = len(self._messages)
        status = self._getter()
        if status > _WARNING:
            raise self._owner.refusal(self._get.name, status, said)
        total = sum(self._numbers)
        if total - total != 0.0:  # as of whatever is not finite, and faster than to ask
            self._check(self._get)

    def write(self) -> None:
        """Set the variables to `values`."""
        said = len(self._messages)
        status = self._putter()
        if status > _WARNING:
            raise self._owner.refusal(self._put.name, status, said)

    def read_slopes(self) -> bool:
        """Fill `values` with derivatives of outputs [unit/s]; False where the FMU does not give some of them."""
        call = self._get_slopes
        if call is None:
            return False
        said = len(self._messages)
        status = self._owner.quietly(call.function)
        if status == Status.DISCARD:
            del self._messages[said:]
            return False
        if status > _WARNING:
            raise self._owner.refusal(call.name, status, said)
        if not math.isfinite(sum(self._numbers)):
            self._check(call)
        return True

    def write_slopes(self) -> None:
        """Let inputs change by `values` [unit/s] in the next step.

        Raises:
            UsageError: the FMU takes no slopes.
            FmuError: it refuses.
        """
        call = self._put_slopes
        if call is None:
            raise no_slopes(self._owner.name, self._names)
        said = len(self._messages)
        status = call.function()
        if status > _WARNING:
            raise self._owner.refusal(call.name, status, said)

    def _check(self, call: Call) -> None:
        """Find what is not finite; a sum may also overflow."""
        for name, value in zip(self._names, self._numbers, strict=True):
            if not math.isfinite(value):
                raise self._owner.failure(call.name, f"{name} is {value}, which is no finite number")


def raw_reals(
    owner: Owner, instance: c_void_p, names: Sequence[str], functions: tuple[str, str, str, str], last: Sequence[Any]
) -> RawReals:
    """Variables that are single numbers of double precision.

    Args:
        owner: the instance.
        instance: it, as the functions of the FMU know it.
        names: of the variables.
        functions: those that get and set values, get derivatives of outputs, and set those of inputs.
        last: what this version of FMI gives them behind all else.
    """
    count = len(names)
    numbers, raw = doubles(count)
    references = (c_uint * count)(*(owner.description.variable(name).reference for name in names))
    plain = instance, references, c_size_t(count)
    first = (c_int * count)(*[1] * count)

    def call(name: str, *arguments: Any) -> Call:
        return Call(name, partial(owner.raw(name), *plain, *arguments, raw, *last) if count else nothing)

    get, put, get_slopes, put_slopes = functions
    calls = (
        call(get),
        call(put),
        call(get_slopes, first) if owner.description.gives_slopes else None,
        call(put_slopes, first) if owner.description.takes_slopes else None,
    )
    return RawReals(owner, names, (numbers, raw), calls)


# Real variables of an FMU that are elements of arrays, or not of double precision: bound without haste.


class Accessible(Protocol):
    """The instance whose variables they are."""

    name: str

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables."""

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables."""

    def failure(self, function: str, reason: str) -> FmuError:
        """What to raise for an answer that cannot be used."""


class ElementReals:
    """Variables of an instance (a `machine.component.Reals`).

    Attributes:
        values: what `read` found and `write` takes.
    """

    def __init__(self, owner: Accessible, names: Sequence[str]) -> None:
        """Bind variables by name."""
        self._owner = owner
        self._names = tuple(names)
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        """Fill `values` with those of now.

        Raises:
            FmuError: the FMU refuses, or a value is not finite.
        """
        self.values[:] = map(float, self._owner.get(self._names))
        for name, value in zip(self._names, self.values, strict=True):
            if not math.isfinite(value):
                raise self._owner.failure("fmi3Get", f"{name} is {value}, which is no finite number")

    def write(self) -> None:
        """Set the variables to `values`."""
        self._owner.set(dict(zip(self._names, self.values, strict=True)))

    def read_slopes(self) -> bool:
        """Nothing is known of them."""
        return False

    def write_slopes(self) -> None:
        """FMUs with such variables take no slopes.

        Raises:
            UsageError: always.
        """
        raise no_slopes(self._owner.name, self._names)
