"""The FMU of `hostile.c`, and what it can do."""

import re
import subprocess
import sys
import zipfile
from enum import IntEnum
from pathlib import Path

import fmpy
from fmpy.fmi2 import FMU2Slave

HERE = Path(__file__).parent


class Harm(IntEnum):
    """As in hostile.c."""

    NOTHING = 0
    EXIT_0 = 1
    QUICK_EXIT_0 = 2
    END_0 = 3
    ABORT = 4
    SEGFAULT = 5
    ABORT_IN_FREE = 6
    EXIT_IN_FREE = 7
    MOVE = 8
    NAN_OUT = 9
    INF_OUT = 10
    FLOOD = 11
    LONG_TEXT = 12
    HANG = 13
    EXIT_IN_INIT = 14
    ERROR_AFTER_FLOOD = 16


def hostile(folder: Path) -> Path:
    """Build it by zig."""
    source = (HERE / "hostile.c").read_text(encoding="utf-8")
    asked = {name for kind in FMU2Slave.__mro__ for name in vars(kind) if name.startswith("fmi2")}
    asked |= set(re.findall(r"fmi2[A-Z]\w+", (Path(fmpy.__file__).parent / "fmi2.py").read_text(encoding="utf-8")))
    there = set(re.findall(r"\b(fmi2\w+)\(", source))
    stubs = "".join(f"int {name}(void) {{ return 3; }}\n" for name in sorted(asked - there))
    (folder / "hostile.c").write_text(source + stubs, encoding="utf-8")
    library = folder / f"hostile{fmpy.sharedLibraryExtension}"
    compiler = [sys.executable, "-m", "ziglang", "cc", "-shared", "-fPIC", "-O1", "-w", "-fno-sanitize=all"]
    subprocess.run([*compiler, str(folder / "hostile.c"), "-o", str(library)], check=True, capture_output=True)
    path = folder / "Hostile.fmu"
    with zipfile.ZipFile(path, "w") as fmu:
        fmu.write(HERE / "modelDescription.xml", "modelDescription.xml")
        fmu.write(library, f"binaries/{fmpy.platform}/{library.name}")
    return path
