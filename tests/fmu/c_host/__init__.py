"""Hosts in C, compiled here for any platform, and the scripts that they run."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import fmpy

from mechanism_fmu.fmu.native.link import surface
from mechanism_fmu.fmu.start import cache_directory

_FOLDER = Path(__file__).parent
_STANDARD = Path(fmpy.__file__).with_name("c-code")
_KINDS = {"Real": "r", "Float64": "r", "Integer": "i", "Int32": "i", "Boolean": "b"}
#: Zig's own run-time library for Windows would take minutes to compile.
_WINDOWS = [
    *("-Dmain=host_main", "-D_UCRT", "-nostdlib", "-Wl,--subsystem,console", "-Wl,--entry,mainCRTStartup"),
    *(f"-lapi-ms-win-crt-{name}-l1-1-0" for name in ("math", "heap", "stdio", "string", "private", "convert")),
    *("-lapi-ms-win-crt-runtime-l1-1-0", "-lkernel32"),
]

COMPILER = shutil.which("cc") or shutil.which("gcc")


class Script:
    """Writes down what it is asked to do, by the names of an `Instance`, for a host in C.

    Attributes:
        lines: of the script.
        time: that the instance will have reached [s].
    """

    def __init__(self, fmu: Any) -> None:
        self.lines = ["make 0"]
        self.time = 0.0
        known = {name: v for name, v in fmu.variables.items() if v.type in _KINDS}
        self._variables = {name: f"{_KINDS[v.type]} {v.valueReference}" for name, v in known.items()}

    def begin(self, start: Mapping[str, float] | None = None) -> Script:
        self.set(start or {})
        return self.say("begin")

    def set(self, values: Mapping[str, float]) -> None:
        for name, value in values.items():
            self.lines.append(f"set {self._variables[name]} {float(value)!r}")

    def get(self, names: Iterable[str]) -> dict[str, float]:
        """Have the values printed; nothing is known of them yet."""
        self.lines += [f"get {self._variables[name]}" for name in names]
        return {}

    def step(self, size: float) -> None:
        self.lines.append(f"step {size!r}")
        self.time += size

    def say(self, *lines: str) -> Script:
        """Lines as they are."""
        self.lines += lines
        return self


@dataclass(frozen=True)
class Printed:
    """What a host has left.

    Attributes:
        code: exit code; that of `refused` calls that were not, and of others that were, is 4.
        numbers: that it printed.
        log: lines of the FMU's log, and complaints.
    """

    code: int
    numbers: list[float]
    log: list[str]


@dataclass(frozen=True)
class Host:
    """A compiled host.

    Attributes:
        program: the executable file.
        runner: what runs it, if not the system itself.
        environment: all of its environment variables.
    """

    program: Path
    runner: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)

    def run(self, fmu: Any, library: str, script: Script, folder: Path) -> Printed:
        """Run a script on a library (its path in the unzipped FMU); `folder` is for the script's file."""
        file = folder / "script.txt"
        file.write_text("\n".join(script.lines) + "\n", encoding="ascii")
        resources = (Path(fmu.folder) / "resources").as_uri()
        arguments = [str(Path(fmu.folder, library)), resources, fmu.description.guid, str(file)]
        done = subprocess.run(
            [*self.runner, str(self.program), *arguments],
            env=dict(self.environment),
            capture_output=True,
            text=True,
            check=False,
        )
        return Printed(done.returncode, [float(text) for text in done.stdout.split()], done.stderr.splitlines())


def compile_host(folder: Path, fmi: int = 2) -> Path:
    """A host for this machine by its own compiler."""
    program = folder / f"host{fmi}"
    _compile([str(COMPILER), "-std=gnu11", "-g"], fmi, ["-ldl"], program)
    return program


def cross_compile_host(folder: Path, target: str) -> Path:
    """A host for a platform, as Zig calls it."""
    program = folder / ("host.exe" if "windows" in target else "host")
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, "-fno-sanitize=all", "-fno-stack-protector"]
    rest = []
    if "windows" in target:
        import ziglang

        headers = Path(ziglang.__file__).with_name("lib") / "libc" / "include" / "any-windows-any"
        own = [_FOLDER / "windows.c", *surface("windows.c")]
        rest = ["-isystem", str(headers), *map(str, own), *_WINDOWS]
    _compile(command, 2, rest, program)
    return program


def _compile(command: list[str], fmi: int, rest: list[str], program: Path) -> None:
    files = [str(_FOLDER / name) for name in ("host.c", f"fmi{fmi}.c")]
    options = ["-O1", "-Wall", "-Wextra", "-Werror", f"-I{_STANDARD}"]
    environment = os.environ | {"ZIG_GLOBAL_CACHE_DIR": str(cache_directory() / "mechanism_fmu" / "zig")}
    command = [*command, *options, *files, *rest, "-o", str(program)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
