"""What the tests of damaged inputs share: how many examples, damage to bytes and texts, and what a refusal must be."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hypothesis import HealthCheck, seed, settings, strategies as st

from harness.errors import UsageError

Read = TypeVar("Read")

_SETTINGS = settings(
    max_examples=int(os.environ.get("FUZZ_EXAMPLES", "100")),
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)


def fuzzed(test: Callable[..., None]) -> Callable[..., None]:
    """Try the same examples each time, seconds in all: `FUZZ_EXAMPLES=100000` takes hours, `FUZZ_SEED=7` others."""
    chosen = os.environ.get("FUZZ_SEED")
    return _SETTINGS(test if chosen is None else seed(int(chosen))(test))


CORPUS = Path(__file__).with_name("corpus")

#: What stands where a number, a name or a text was.
NASTY = (
    *("", " ", "0", "-1", "1e999", "-inf", "nan", "NaN", "0x10", "1_000", "1,5", "٣", "9" * 400, "9" * 5000, "1e-999"),
    *(
        "true",
        "None",
        "abc",
        "a b",
        "../../x",
        "/etc/passwd",
        "C:\\x",
        "x" * 300,
        "a;b",
        "{}",
        "%s%n",
        "é\u202e",
        "]]>",
    ),
    *("4294967296", "18446744073709551616", "-2147483649", "2.5", "1 2 3", "-0.0"),
)
nasty = st.sampled_from(NASTY)


@st.composite
def damaged(draw: st.DrawFn, sound: bytes) -> bytes:
    """Bytes with a few of them changed, removed, put in or exchanged, or cut off."""
    data = bytearray(sound)
    for _ in range(draw(st.integers(1, 6))):
        place = draw(st.integers(0, max(len(data) - 1, 0)))
        length = draw(st.integers(0, 24))
        how = draw(st.sampled_from(["change", "remove", "insert", "copy", "cut"]))
        if how == "change":
            data[place : place + length] = draw(st.binary(min_size=length, max_size=length))
        elif how == "remove":
            del data[place : place + length]
        elif how == "insert":
            data[place:place] = draw(st.binary(max_size=24))
        elif how == "copy":
            other = draw(st.integers(0, max(len(data) - 1, 0)))
            data[place : place + length] = data[other : other + length]
        elif draw(st.booleans()):
            del data[place:]
    return bytes(data)


def read_or_refused(read: Callable[[], Read], path: Path, says: str = "") -> Read | None:
    """What is read; None where it is refused, in a message that names the file (or else what it `says`).

    Any other exception is a traceback on the screen, and fails the test that calls this.
    """
    try:
        return read()
    except UsageError as error:
        text = str(error)
    assert (says or path.name) in text
    assert len(text) < 20_000
    assert "Traceback" not in text
    return None
