"""What a machine runs out of at any place: memory, and room where something is printed."""

from __future__ import annotations

import errno
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress

#: What systems call a full disk, a file that may not become longer, and a full share of a disk.
NO_ROOM = frozenset(getattr(errno, name) for name in ("ENOSPC", "EFBIG", "EDQUOT") if hasattr(errno, name))
#: How the system says in the loading of a library that it has no memory for it.
_NOT_LOADED = ("failed to map segment", "cannot allocate memory")
_FAILED = 1


@contextmanager
def exhaustion_told() -> Iterator[None]:
    """Say in a line that memory or a disk is full, and end with an exit code that says so; nothing of it is imported.

    Files that are written say so themselves (`results`).

    Raises:
        SystemExit: it is.
    """
    try:
        yield
    except MemoryError:
        _end("The memory is full.")
    except ImportError as error:
        if not any(words in str(error).lower() for words in _NOT_LOADED):
            raise
        _end(f"The memory is full: {error}.")
    except OSError as error:
        if error.errno == errno.ENOMEM:
            _end(f"The memory is full: {error}.")
        if error.errno in NO_ROOM:
            _end(f"There is no room for what is printed or written: {error}.")
        raise


def _end(reason: str) -> None:
    with suppress(OSError):
        print(f"Error: {reason} What was recorded before is kept.", file=sys.stderr)
    raise SystemExit(_FAILED) from None
