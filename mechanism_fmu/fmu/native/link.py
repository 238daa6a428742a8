"""Linking of shared libraries for all platforms from objects and C files, with the tools of the `ziglang` wheel."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import struct
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...model import MechanismError
from ..start import cache_directory

# The platforms that a native FMU has a binary for.


@dataclass(frozen=True)
class Target:
    """A platform.

    Attributes:
        name: of the folder in an FMI 3.0 FMU (specification 3.0, section 2.5.1.4.1).
        fmi2: of the folder in an FMI 2.0 FMU; two for one folder become a universal binary. FMI 2.0 has no name for
            Linux on ARM: the folder named as in 3.0 is for importers that look there, and for hands.
        triple: what LLVM calls it.
        zig: what `zig cc -target` calls it: the oldest system library that the binary runs with is part of it.
        suffix: of shared libraries.
    """

    name: str
    fmi2: str
    triple: str
    zig: str
    suffix: str


#: The platforms that pythonfmu's wheel has a wrapper for.
WRAPPED = ("linux64", "win64")

TARGETS = (
    Target("x86_64-linux", "linux64", "x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17", ".so"),
    Target("x86_64-windows", "win64", "x86_64-pc-windows-msvc", "x86_64-windows-gnu", ".dll"),
    Target("x86_64-darwin", "darwin64", "x86_64-apple-macosx11.0.0", "x86_64-macos.11.0", ".dylib"),
    Target("aarch64-linux", "aarch64-linux", "aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17", ".so"),
    Target("aarch64-darwin", "darwin64", "arm64-apple-macosx11.0.0", "aarch64-macos.11.0", ".dylib"),
)

#: The browser: no platform of FMUs, and nothing of it goes into one.
WEB = Target("wasm32", "", "wasm32-unknown-unknown", "wasm32-wasi", ".wasm")


# Universal binaries of macOS: FMI 2.0 has one folder for both of its processors.

_MAGIC = 0xCAFEBABE
#: Each library begins at a multiple of 2^14 bytes, the page of Apple's own processors.
_ALIGNMENT = 14
_HEAD, _ENTRY = struct.Struct(">II"), struct.Struct(">5I")


def universal(libraries: Sequence[bytes]) -> bytes:
    """One file of Mach-O libraries for different processors (`fat_header` and `fat_arch` of mach-o/fat.h)."""
    entries, body = [], b""
    place = _HEAD.size + len(libraries) * _ENTRY.size
    for library in libraries:
        body += bytes(-(place + len(body)) % 2**_ALIGNMENT)
        processor, kind = struct.unpack_from("<II", library, 4)
        entries.append(_ENTRY.pack(processor, kind, place + len(body), len(library), _ALIGNMENT))
        body += library
    return _HEAD.pack(_MAGIC, len(libraries)) + b"".join(entries) + body


# From objects and C files to a shared library, with the C compiler and linker of the `ziglang` wheel.

_SURFACE = Path(__file__).with_name("c")

#: The files of the C surface, each using those before it; both versions of FMI stand in one library.
SURFACE = ("log.c", "instance.c", "exchange.c", "values.c", "saved_check.c", "saved.c", "fmi2.c", "fmi3.c")
HEADERS = ("model.h", "instance_data.h", "log.h", "instance.h", "saved.h", "exchange.h")
#: Those of the browser's module.
WEB_SURFACE = (*(name for name in SURFACE if name != "fmi2.c"), "loaded.c", "page.c")


def standard() -> Path:
    """The folder of the headers of both standards, which the package fmpy brings."""
    spec = importlib.util.find_spec("fmpy")
    return Path(str(spec and spec.origin)).with_name("c-code")


_FLAGS = (  # of all targets
    "-std=gnu11",  # c11 would take ??! in a text for a trigraph
    "-Oz",  # what takes time is in the engine's object
    "-Wall",
    "-Wextra",
    "-Werror",
    "-ffp-contract=off",  # the numbers of Python: no fused multiply-add
    "-fno-sanitize=all",
    "-fno-stack-protector",
    "-fvisibility=hidden",
    "-s",
)

#: Of FMI 3.0, and of the C library, what a page calls; other functions say so themselves.
_WEB_EXPORTS = (
    *("malloc", "free", "fmi3FreeInstance"),
    *(f"fmi3{access}{kind}" for access in ("Get", "Set") for kind in ("Float64", "Int32", "Boolean")),
)

#: A module that a page calls, with 256 kB of stack in place of 16 MB, and with the model as data.
_WEB_FLAGS = (
    *("-mexec-model=reactor", "-Wl,-z,stack-size=262144", "-DMODEL_IS_LOADED"),
    *(f"-Wl,--export={name}" for name in _WEB_EXPORTS),
)

#: Nothing here throws, and the engine's object has no tables for it either: 9 kB of the FMU. Windows wants them.
_NO_UNWINDING = ("-fno-unwind-tables", "-fno-asynchronous-unwind-tables")

#: Windows: straight on the system's own C library (the Universal CRT), whose import libraries zig makes in no time; its
#: mingw runtime would take minutes to compile and add nothing that is used.
_WINDOWS_LIBRARIES = ("math", "heap", "stdio", "string", "private")


#: How to get the version that the extra `native` pins.
INSTALL = "python -m pip install ziglang==0.17.0"


def has_linker() -> bool:
    """Whether the `ziglang` wheel is installed."""
    return importlib.util.find_spec("ziglang") is not None


def need_linker(what: str = "A native FMU") -> None:
    """Refuse to go on without the `ziglang` wheel.

    Args:
        what: needs it, as the first words of the message.

    Raises:
        MechanismError: it is not installed.
    """
    if not has_linker():
        raise MechanismError(
            f"{what} needs the linker of the package ziglang, which is not installed. Install it: {INSTALL}"
        )


def link(target: Target, inputs: Sequence[Path], includes: Sequence[Path], path: Path) -> None:
    """Link C files and objects to a shared library for a platform, or to a module for the browser.

    Args:
        target: the platform, or `WEB`.
        inputs: C files and objects.
        includes: folders of C headers, beside the surface's own.
        path: of the library; its name becomes part of the file on some platforms.

    Raises:
        MechanismError: there is no linker, or it has refused, with what it printed.
    """
    need_linker()
    headers = [f"-I{folder}" for folder in (_SURFACE, *includes)]
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target.zig, *_FLAGS, *headers]
    command += [*map(str, inputs), *_platform(target), "-o", path.name]
    done = subprocess.run(command, cwd=path.parent, env=_environment(), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise MechanismError(f"Linking for {target.name} failed:\n{done.stderr.strip()}")


def warm_up(target: Target) -> None:
    """Let the linker compile what it needs of the system's C library, which it keeps, while the engine is compiled.

    Whether it succeeds does not matter: then the link itself takes longer, or says what is wrong.

    Args:
        target: the platform, or `WEB`.
    """
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        (Path(folder) / "nothing.c").write_text("int nothing;\n", encoding="ascii")
        flags = ["-mexec-model=reactor"] if target is WEB else _platform(target)
        command = [sys.executable, "-m", "ziglang", "cc", "-target", target.zig, *_FLAGS, "nothing.c", *flags]
        subprocess.run([*command, "-o", "nothing"], cwd=folder, env=_environment(), capture_output=True, check=False)


def _environment() -> dict[str, str]:
    return {**os.environ, "ZIG_GLOBAL_CACHE_DIR": str(cache_directory() / "mechanism_fmu" / "zig")}


def linked_with(*names: str) -> dict[str, bytes]:
    """What decides on the bytes of a library beside objects and generated files: contents by name."""
    files = [Path(__file__), *surface(*names, "windows.c")]
    return {
        **{file.name: file.read_bytes() for file in files},
        "ziglang": importlib.metadata.version("ziglang").encode(),
    }


def surface(*names: str) -> list[Path]:
    """C files of the surface by name."""
    return [_SURFACE / name for name in names]


def _platform(target: Target) -> list[str]:
    if target is WEB:
        return list(_WEB_FLAGS)
    if not target.name.endswith("windows"):
        # Without zig's own runtime library: nothing needs it, and compiling it took half a minute of the first build.
        return [
            "-shared",
            *_NO_UNWINDING,
            "-fPIC",
            "-nostdlib",
            "-lc",
            "-lm",
            *(["-Wl,-z,defs", "-Wl,--hash-style=gnu"] if target.suffix == ".so" else []),
        ]
    libc = _zig_library() / "libc" / "include" / "any-windows-any"
    libraries = [f"-lapi-ms-win-crt-{name}-l1-1-0" for name in _WINDOWS_LIBRARIES]
    return ["-shared", "-nostdlib", "-isystem", str(libc), "-D_UCRT", *map(str, surface("windows.c")), *libraries]


def _zig_library() -> Path:
    spec = importlib.util.find_spec("ziglang")
    return Path(str(spec and spec.origin)).with_name("lib")
