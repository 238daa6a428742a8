"""A folder for an extracted FMU, with a path that every FMU can load from."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import UsageError

#: FMUs made by pythonfmu 0.7.0 crash the process when the path to them has `# % + ? &` or letters beyond ASCII.
_PLAIN = re.compile(r"[A-Za-z0-9_./\\:~-]+")


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A new empty folder with a plain path; it is removed afterwards.

    Raises:
        UsageError: there is no place for it.
    """
    folder = Path(tempfile.mkdtemp(prefix="mechanism-fmu-", dir=_plain_place()))
    try:
        yield folder
    finally:
        # On Windows the library stays locked until the process ends; a leftover there is not worth a failure.
        shutil.rmtree(folder, ignore_errors=True)


def _plain_place() -> str:
    places = [tempfile.gettempdir(), "/tmp", "/var/tmp", os.environ.get("PUBLIC", "")]
    for place in places:
        if _PLAIN.fullmatch(place) and os.path.isdir(place) and os.access(place, os.W_OK):
            return place
    raise UsageError(
        f"The temporary folder '{places[0]}' has characters in its path that make FMUs crash "
        "(only plain letters, digits and _ . - are safe); set the environment variable TMPDIR to another one."
    )
