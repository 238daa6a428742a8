"""FMI Library 3, which many tools are made with, around a program in C.

Neither PyPI nor Debian has it: the environment variable FMILIB names the folder that it is installed in. It must have
nothing to say about modelDescription.xml. Its reading of terminalsAndIcons.xml is experimental, by its own release
notes: it does not know the attributes of the members.
"""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

from tests.importers.asked import Asked
from tests.importers.in_c import BY_PYTHONFMU, libpython, missing as compiler_missing
from tests.importers.tool import Tool, Values

_INSTALL = (
    "not installed: cmake and make install of github.com/modelon-community/fmi-library, and FMILIB=<its install folder>"
)
_OF_TERMINALS = re.compile(
    r"Unknown attribute '(matchingRule|terminalKind|memberName|variableName|variableKind)=|"
    r"'description' not processed by element 'Terminal'|element '(GraphicalRepresentation|CoordinateSystem|Icon)'"
)


def missing() -> str:
    return compiler_missing() or ("" if (_folder() / "include" / "fmilib.h").is_file() else _INSTALL)


def run(asked: Asked) -> Values:
    folder = Path(asked.folder)
    program, unzipped = folder / "fmi_library", folder / "unzipped"
    unzipped.mkdir()
    library = _folder() / "lib"
    source = Path(__file__).with_name("fmi_library_exchange.c" if asked.exchange else "fmi_library.c")
    compile_it = ["cc", "-O1", "-Wall", "-Wextra", "-Werror", "-isystem", str(_folder() / "include"), str(source)]
    linked = [f"-L{library}", f"-Wl,-rpath,{library}", "-lfmilib_shared", "-ldl", "-lm", "-o", str(program)]
    subprocess.run([*compile_it, *linked], check=True)
    arguments = [asked.fmu, str(unzipped), repr(asked.step), str(asked.steps)]
    if not asked.exchange:
        arguments.append(str(int(asked.event_mode)))
    environment = {**os.environ, **libpython()} if asked.needs_python else {}
    command = [str(program), *arguments, *asked.names()]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    said = [line for line in done.stderr.splitlines() if not _OF_TERMINALS.search(line)]
    if done.returncode or said:
        raise RuntimeError(f"exit code {done.returncode}: {said}")
    return dict(zip(asked.names(), map(float, done.stdout.split()), strict=True))


def version() -> str:
    name = (_folder() / "lib" / "libfmilib_shared.so").resolve().name
    return name.partition(".so.")[2]


def _folder() -> Path:
    return Path(os.environ.get("FMILIB", "/usr/local"))


_FORMS = ("fmi2", "fmi3", "fmi3_events", "clocks", *BY_PYTHONFMU, "exchange2", "exchange3")
TOOL = Tool("FMI Library", _FORMS, run, missing, version)
