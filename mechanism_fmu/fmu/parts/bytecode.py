"""The sources that travel in an FMU, compiled for the Python that builds it: then a first start compiles nothing."""

from __future__ import annotations

import hashlib
import importlib.util
import marshal
import sys
from collections.abc import Mapping

#: Flags of a .pyc file: it belongs to a source of one hash (PEP 552), and whoever imports it looks whether that fits.
_OF_A_HASH = (0b11).to_bytes(4, "little")

#: What `marshal` writes without references between objects, which would depend on what else this process has loaded.
_WITHOUT_REFERENCES = 2


def bytecode(sources: Mapping[str, bytes]) -> dict[str, bytes]:
    """Compiled code of Python sources, by the names under which Python looks for it beside them.

    It is for the Python that runs this, of any platform; another one compiles the sources itself, and also what has
    been changed. Each file ends with its digest, as `start.CheckedLoader` wants it; Python itself does not read so far.

    Args:
        sources: texts of modules by name of the file, "a/b.py".

    Raises:
        SyntaxError: a text that is no Python.
    """
    found = {}
    for name, text in sources.items():
        code = compile(text, "", "exec", dont_inherit=True, optimize=0)
        head = importlib.util.MAGIC_NUMBER + _OF_A_HASH + importlib.util.source_hash(text)
        try:
            whole = head + marshal.dumps(code, _WITHOUT_REFERENCES)
        except ValueError:
            continue  # a constant that this form does not know, as slices from Python 3.14 on
        folder, _, file = name.rpartition("/")
        # not by importlib, which puts it elsewhere where PYTHONPYCACHEPREFIX says so
        place = f"__pycache__/{file.removesuffix('.py')}.{sys.implementation.cache_tag}.pyc"
        found[f"{folder}/{place}" if folder else place] = whole + hashlib.sha256(whole).digest()
    return found
