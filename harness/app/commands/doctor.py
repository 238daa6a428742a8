"""`doctor`: what is installed here, what is not, and what that means."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import platform
import re
import sys
from pathlib import Path
from typing import NamedTuple

from ...errors import EXTRAS, way_to_get


class Found(NamedTuple):
    """One line: what was looked for, what was found, whether all is well, and what follows."""

    what: str
    found: str
    well: bool
    needed: bool
    follows: str


def examine() -> int:
    """Show what is there and what is missing; 1 if something is missing that everything needs."""
    found = [*_python(), *_packages()]
    if all(line.well for line in found if line.needed):  # what follows needs them
        found += [_linker(), *_cache(), _wrapper()]
    try:
        from ..output import give
        from ..terminal import show_wide_table
    except ImportError:
        print("\n".join(f"{line.what}: {line.found if line.well else 'missing'}; {line.follows}" for line in found))
        return 1
    give({"found": [line._asdict() for line in found]})
    states = {True: "ok", False: "missing"}
    rows = [
        (line.what, line.found, states[line.well] if line.needed or line.well else "not here", line.follows)
        for line in found
    ]
    show_wide_table("What is here", ("what", "found", "state", "what it means"), rows)
    return int(any(line.needed and not line.well for line in found))


def _python() -> list[Found]:
    version = platform.python_version()
    wide = sys.maxsize > 2**32
    return [
        Found("Python", f"{version}, {sys.executable}", sys.version_info >= (3, 11), True, "3.11 or later"),
        Found("System", f"{platform.system()} {platform.machine()}", wide, True, "64 bits"),
    ]


#: What packages are for, of those that people ask about.
_PURPOSES = {
    "numpy": "arrays",
    "fmpy": "runs FMUs",
    "pythonfmu": "builds the FMU that runs in Python",
    "pandas": "result tables",
}
#: What extras bring, and what for.
_EXTRAS = {
    "scipy": "linkages that bend (`ked`), profiles of cams, the papers reproduced",
    "pyarrow": "sweeps, optimum design, the study; tables as Parquet",
    "pillow": "the study, whose figures are pictures, too",
    "plotly": "charts by `plot` of a result of `simulate`",
    "distributed": "sweeps on a cluster",
    "optuna": "optimum design by the method 'tpe'",
    "libcosimpy": "checks against another master",
    "numba": "compiles the engine after a change of its sources",
}
#: Modules whose name is not that of their package.
_MODULES = {"pillow": "PIL", "markdown-it-py": "markdown_it"}


def _packages() -> list[Found]:
    """What the package itself says that it needs, and what of extras is here and what is not."""
    required = [
        re.split(r"[^\w-]", text)[0]
        for text in importlib.metadata.requires("mechanism_fmu") or ()
        if "extra ==" not in text
    ]
    found = []
    for name in dict.fromkeys((*required, *_EXTRAS)):
        module = _MODULES.get(name, name)
        version, there = _version(name)
        there = there and importlib.util.find_spec(module) is not None
        needed = name in required
        purpose = _PURPOSES.get(name, "") if needed else _EXTRAS[name]
        if not there:
            command = f"python -m pip install {name}" if needed else way_to_get(EXTRAS[module])
            purpose = f"{purpose}; get it: {command}".removeprefix("; ")
        found.append(Found(name, version, there, needed, purpose))
    return found


def _version(package: str) -> tuple[str, bool]:
    try:
        return importlib.metadata.version(package), True
    except importlib.metadata.PackageNotFoundError:
        return "-", False


def _linker() -> Found:
    from mechanism_fmu.fmu.native.link import INSTALL, has_linker

    tested = INSTALL.split("==")[1]
    version, there = _version("ziglang")
    purpose = "links native FMUs, and the engine after a change of its sources"
    if not there or not has_linker():
        return Found("ziglang", "-", False, False, f"{purpose}; get it: {INSTALL}")
    if version != tested:
        return Found("ziglang", version, False, False, f"{tested} is the one that was tested: {INSTALL}")
    return Found("ziglang", version, True, False, purpose)


def _cache() -> list[Found]:
    from mechanism_fmu.fmu.native.objects import engine_is_compiled
    from mechanism_fmu.fmu.start import private_cache

    try:
        folder = private_cache()
        size = sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())
        compiled = engine_is_compiled()
    except (OSError, ImportError) as error:
        hint = "The environment variable MECHANISM_FMU_CACHE chooses another folder."
        return [Found("Cache", str(error), False, True, hint)]
    return [
        Found("Cache", f"{folder}, {size / 1e6:.0f} MB", True, True, "what was compiled; may be deleted"),
        Found(
            "Engine",
            "compiled for all platforms" if compiled else "not compiled yet",
            compiled,
            False,
            _of_engine(compiled),
        ),
    ]


def _of_engine(compiled: bool) -> str:
    """What follows from whether the engine is compiled."""
    from mechanism_fmu.fmu.native.objects import INSTALL, has_compiler

    if compiled:
        return "nothing is compiled in a run; a build needs seconds"
    if has_compiler():
        return "the first run or build compiles it, in one or two minutes"
    return f"nothing can run; compile it: {INSTALL}"


def _wrapper() -> Found:
    from mechanism_fmu.fmu.native.link import WRAPPED

    here = {"Linux": "linux64", "Windows": "win64", "Darwin": "darwin64"}.get(platform.system(), "")
    processor = platform.machine().lower() in ("x86_64", "amd64")
    runs = here in WRAPPED and processor
    return Found(
        "pythonfmu's wrapper",
        here if runs else "none for this system",
        runs,
        False,
        "FMUs of the flavour pythonfmu run here" if runs else "use --flavour native here",
    )
