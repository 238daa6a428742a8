"""A number, and the parts of a run that find some: what is missing here, or fails, ends its own part alone."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path

#: Packages that parts need, and the extra that each comes with.
_EXTRAS = {"mujoco": "bench", "numba": "dev", "pyarrow": "designs", "scipy": "analysis", "ziglang": "native"}


@dataclass(frozen=True)
class Number:
    """A number: what it is of, its name there, its unit."""

    group: str
    name: str
    unit: str
    value: float


@dataclass(frozen=True)
class Part:
    """Some numbers, found together.

    Attributes:
        name: what runs.
        measure: finds them, with an empty folder for its files.
        needs: packages without which it is left out; each has its extra in `_EXTRAS`.
        lacks: errors by which it says that something else it needs is not installed.
    """

    name: str
    measure: Callable[[Path], Iterable[Number]]
    needs: tuple[str, ...] = ()
    lacks: tuple[type[Exception], ...] = ()


@dataclass
class Found:
    """What parts have found.

    Attributes:
        numbers: of those that ran.
        left_out: why, by the names of those for which something is not installed.
        failed: likewise, of those that ended with another error.
    """

    numbers: list[Number] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)


def find(parts: Sequence[Part], folder: Path, say: Callable[[str], None]) -> Found:
    """Run parts one after the other.

    Args:
        parts: which.
        folder: an empty one.
        say: is called with the name of each before it runs.
    """
    found = Found()
    for k, part in enumerate(parts):
        say(part.name)
        missing = [package for package in part.needs if not is_here(package)]
        if missing:
            found.left_out[part.name] = "; ".join(
                f"{package} is not installed: python -m pip install -e '.[{_EXTRAS[package]}]'" for package in missing
            )
            continue
        lacks: tuple[type[Exception], ...] = (ModuleNotFoundError, *part.lacks)
        place = folder / str(k)
        place.mkdir()
        try:
            found.numbers += list(part.measure(place))
        except lacks as error:
            found.left_out[part.name] = str(error)
        except Exception as error:  # what the others find is kept
            found.failed[part.name] = f"{type(error).__name__}: {error}"
    return found


def is_here(package: str) -> bool:
    """Whether a package is installed."""
    return find_spec(package) is not None
