"""A plain program in C: nothing of Python around the FMU, but libpython for the form by pythonfmu."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import sysconfig
from pathlib import Path

from tests.fmu.c_host import COMPILER, Host, Script, compile_host
from tests.importers.asked import Asked
from tests.importers.tool import Tool, Values

_LIBPYTHON = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("INSTSONAME") or "none")
#: Only where this Python has a shared library, which a program in C can load.
BY_PYTHONFMU = ("pythonfmu",) if ".so" in _LIBPYTHON.name and _LIBPYTHON.is_file() else ()


def missing() -> str:
    there = sys.platform == "linux" and platform.machine() == "x86_64" and COMPILER
    return "" if there else "needs Linux on x86_64 and a C compiler (apt install gcc)"


def run(asked: Asked) -> Values:
    from tests.fmu.conformance.host import Fmu
    from tests.fmu.native.host3 import Fmu3

    folder = Path(asked.folder)
    fmu = (Fmu if asked.fmi == 2 else Fmu3).unzip(Path(asked.fmu), folder / "unzipped")
    script = Script(fmu).begin()
    script.say(f"step {asked.step!r} {asked.steps}")
    script.get(asked.names())
    environment = {**os.environ, **libpython()} if asked.needs_python else {}
    place = "linux64" if asked.fmi == 2 else "x86_64-linux"
    host = Host(compile_host(folder, asked.fmi), environment=environment)
    printed = host.run(fmu, f"binaries/{place}/{asked.model}.so", script.say("free"), folder)
    if printed.code:
        raise RuntimeError("\n".join(printed.log))
    return dict(zip(asked.names(), printed.numbers, strict=True))


def libpython() -> dict[str, str]:
    """Environment in which a program in C finds the Python library that pythonfmu's wrapper uses, and its packages."""
    return {"LD_PRELOAD": str(_LIBPYTHON), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}


def version() -> str:
    done = subprocess.run([str(COMPILER), "-dumpfullversion"], capture_output=True, text=True, check=True)
    return f"gcc {done.stdout.strip()}"


TOOL = Tool(
    "program in C",
    ("fmi2", "fmi3_events", "clocks", *BY_PYTHONFMU),
    run,
    missing,
    version,
    "it always uses event mode in FMI 3.0",
)
