"""A folder for an extracted FMU, with a path that every FMU can load from."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from mechanism_fmu.fmu import temporary

from ..errors import UsageError

#: FMUs made by pythonfmu 0.7.0 crash the process when the path to them has `# % + ? &` or letters beyond ASCII.
_PLAIN = re.compile(r"[A-Za-z0-9_./\\:~-]+")


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A new empty folder with a plain path; it is removed afterwards, and those of killed processes before.

    Raises:
        UsageError: there is no place for it.
    """
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(temporary.temporary_folder(_plain_place()))
        except OSError as error:
            raise UsageError(
                f"No temporary folder can be made ({error}); set the environment variable TMPDIR to a folder with room."
            ) from error
        yield folder


def _plain_place() -> Path:
    places = [tempfile.gettempdir(), "/tmp", "/var/tmp", os.environ.get("PUBLIC", "")]
    for place in places:
        if _PLAIN.fullmatch(place) and os.path.isdir(place) and os.access(place, os.W_OK):
            return Path(place)
    raise UsageError(
        f"The temporary folder '{places[0]}' has characters in its path that make FMUs crash "
        "(only plain letters, digits and _ . - are safe); set the environment variable TMPDIR to another one."
    )
