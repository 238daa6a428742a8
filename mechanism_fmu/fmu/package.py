"""Packaging of a model as an FMU file, by way of pythonfmu's builder."""

from __future__ import annotations

import re
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from pythonfmu.builder import FmuBuilder

from ..model import MechanismError
from ..model.baked import NOTHING_BAKED, Baked
from ..model.mechanism import curve_owners
from .disk.archive import content_hash, read_entries, with_guid, write_archive
from .disk.folders import temporary_folder
from .disk.user_cache import record_build
from .instance.self_check import StartError
from .native.link import WRAPPED
from .native.objects import Report, engine_libraries, has_libraries, library_of, silently
from .parts.bytecode import bytecode
from .parts.contents import Closure, Home, closure, common_entries, file_in, model_of
from .parts.documentation import dependencies
from .parts.reference_results import reference_results

_LIBRARY = Path(__file__).parents[1]

#: Imports that ask for nothing: pythonfmu travels in the FMU, and numba brings llvmlite.
_BROUGHT_ALONG = {"pythonfmu", "llvmlite"}

#: The first that a zip archive can write down.
_FIRST_YEAR = 1980

#: What compiles the engine where it does not travel compiled.
_COMPILER = "numba"

#: What pythonfmu's wrapper decides by itself, whatever the model does.
_WRAPPER = (
    "The FMU needs a 64-bit Python 3.11 or later with the packages of <code>resources/requirements.txt</code>; "
    "binaries for Linux and Windows are inside.",
    "A host that is not itself Python must load the Python library first, on Linux with "
    "<code>LD_PRELOAD</code> and the full path of, for example, <code>libpython3.11.so</code>, and lets Python find "
    "the packages with <code>PYTHONPATH</code>. Hosts that refuse <code>needsExecutionTool</code> cannot run it.",
    "A value or a call that is refused gives a message in the log and the status <em>fatal</em>, because the wrapper "
    "knows no milder one; the instance can be reset or freed all the same. Messages arrive only if the host switched "
    "logging on.",
    "Any GUID and any FMU type are accepted at instantiation.",
    "Unzip the FMU to a path of ASCII letters without <code># % + ? &amp;</code>; other paths crash the host.",
    "Each instantiation in the same process costs less than 1 kB of memory that is not given back.",
    "The engine is inside, compiled for the platforms that <code>resources/requirements.txt</code> names; elsewhere, "
    "or if it names none, the first start compiles it with numba (some seconds).",
    "What runs is kept in the user's cache directory, in a folder <code>mechanism_fmu</code>; the environment variable "
    "<code>MECHANISM_FMU_CACHE</code> chooses another. The folder may be deleted at any time.",
)

#: The slave file: it only imports, because a class defined here would leak at every instantiation.
_SLAVE = '''"""What pythonfmu's wrapper runs first; the code is in the package beside this file."""

from {start} import slave_class, tidy_up

{model} = slave_class("{package}", "{module}"{baked})
tidy_up(globals())
'''


def build_fmu(
    module: ModuleType, destination: Path, report: Report = silently, *, baked: Baked = NOTHING_BAKED
) -> Path:
    """Build the FMU of a model: the same bytes from the same sources and versions of the tools.

    The engine travels compiled, as the installation has compiled it, or the extra `dev` does after a change of its
    sources. Without either, it is compiled on the way for this machine alone.

    Args:
        module: what holds `MODEL`, e.g. `models.ratchet.model`; it may import its neighbours, models in folders beside
            its own (`from ..ratchet.start import ...`), and `mechanism_fmu`.
        destination: folder, made if need be, for "<model name>.fmu".
        report: see `native.objects.compiled_engine`.
        baked: numbers that this FMU has as its own.

    Returns:
        Path of the FMU.

    Raises:
        MechanismError: the module has no model, or a model that cannot travel.
        OSError: the destination cannot be written.
    """
    origin = model_of(module, baked)
    model, folder = origin.model, origin.folder
    path = file_in(destination, f"{model.name}.fmu")
    place = f"models.{model.name.lower()}"
    home = Home(module.__name__.rpartition(".")[0], folder, place, is_package=not origin.own)
    homes = (Home("mechanism_fmu", _LIBRARY, ""), home, *(() if origin.own else _beside(home)))
    main = f"{place}.{module.__name__.rpartition('.')[2]}"
    sources = closure(homes, ("fmu.instance.slave", *(() if baked == NOTHING_BAKED else ("model.baked",)), main))
    code = {name: text.encode() for name, text in sources.files.items()}
    compiled = engine_libraries(report) if has_libraries() else {}
    code |= {f"engine/compiled/{name}": library for name, library in compiled.items()}
    start = (_LIBRARY / "fmu" / "start.py").read_text(encoding="utf-8")

    given = _as_arguments(baked)
    # One name for one content: a process that loads several FMUs then never runs the code of the wrong one.
    smooths = any(curve.smoothing is not None for _, curve in curve_owners(model.build(model.values())))
    starting = f"{_SLAVE}{model.name}{main}{given}".encode()
    digest = content_hash({**code, "start": start.encode(), "slave": starting})[:12]
    package, starter = f"mechanism_fmu_{digest}", f"start_{digest}"
    slave = _SLAVE.format(start=starter, model=model.name, package=package, module=main, baked=given)
    entries, imported = _built_by_pythonfmu(
        f"{model.name}_{digest}",
        {
            f"{model.name}_{digest}.py": slave.encode(),
            f"{starter}.py": start.encode(),
            "requirements.txt": _requirements(sources, bool(compiled), smooths).encode(),
            **{f"{package}/{name}": contents for name, contents in code.items()},
        },
    )
    entries |= common_entries(origin, _WRAPPER, ("mechanism_fmu", "pythonfmu"))
    # These follow from all that the fingerprint is of: last digits of results may be those of this machine, and what a
    # start imports is compiled for this Python.
    follows = reference_results(model, library_of(report))
    early = {name for name in entries if name in imported or name.startswith("resources/pythonfmu/")}
    follows |= bytecode({name: entries[name] for name in early if name.endswith(".py")})
    write_archive(with_guid(entries) | follows, path)
    return record_build(path)


def _beside(home: Home) -> Iterator[Home]:
    """Models in the folders beside that of a model: it may share their geometry."""
    parent = home.name.rpartition(".")[0]
    for path in sorted(home.folder.parent.glob("*/model.py")):
        name = path.parent.name
        if path.parent != home.folder and f"models.{name}" != home.place:
            yield Home(f"{parent}.{name}", path.parent, f"models.{name}")


def _as_arguments(baked: Baked) -> str:
    """What is baked, as further arguments of `start.slave_class`; "" for nothing."""
    if baked == NOTHING_BAKED:
        return ""
    starts = tuple((name, float(start)) for name, start in baked.starts.items())
    inputs = tuple((name, (float(s.factor), float(s.offset), s.unit)) for name, s in baked.inputs.items())
    return f", {starts!r}, {inputs!r}"


def _built_by_pythonfmu(slave: str, resources: Mapping[str, bytes]) -> tuple[dict[str, bytes], set[str]]:
    """Entries of the FMU that pythonfmu makes of a slave module and other files beside it; and which a start imports.

    Raises:
        MechanismError: the model cannot start, or the clock is wrong.
    """
    if time.localtime().tm_year < _FIRST_YEAR:
        raise MechanismError(
            f"The clock of this machine says {time.strftime('%Y-%m-%d')}, and pythonfmu's archives begin with "
            f"{_FIRST_YEAR}; set the clock, or build with --flavour native."
        )
    with temporary_folder() as temporary, _temporary_files_in(temporary), _imports_left_alone(slave):
        staged = temporary / "staged"
        for name, contents in resources.items():
            path = staged / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(contents)
        script = staged / f"{slave}.py"
        others = set(staged.iterdir()) - {script}
        try:
            built = FmuBuilder.build_FMU(script, dest=temporary / "built", project_files=others)
            return read_entries(built), _imported(slave)
        except ValueError as error:
            # pythonfmu makes an instance; the copy of the library in it has error classes of its own.
            for known in (MechanismError, StartError):
                if type(error).__name__ == known.__name__:
                    raise known(str(error)) from error
            raise


def _imported(slave: str) -> set[str]:
    """The entries of an FMU's own modules that have been imported to start it."""
    names = (name.replace(".", "/") for name in _own_modules(slave))
    return {f"resources/{name}{end}" for name in names for end in (".py", "/__init__.py")}


def _own_modules(slave: str) -> dict[str, ModuleType]:
    """What is loaded of an FMU's own modules, which no other contents have."""
    digest = slave.rpartition("_")[2]
    return {name: module for name, module in sys.modules.items() if name.partition(".")[0].endswith(digest)}


@contextmanager
def _temporary_files_in(folder: Path) -> Iterator[None]:
    """Let pythonfmu make its temporary folder where somebody removes it if this process is killed."""
    before, tempfile.tempdir = tempfile.tempdir, str(folder)
    try:
        yield
    finally:
        tempfile.tempdir = before


@contextmanager
def _imports_left_alone(slave: str) -> Iterator[None]:
    """Restore `sys.path`, and the FMU's modules as they were; what they import from elsewhere stays.

    Within, none of them is loaded, whatever this process has run before: an FMU has the same bytes then.
    """
    path, before = sys.path[:], _own_modules(slave)
    for name in before:
        del sys.modules[name]
    try:
        yield
    finally:
        sys.path[:] = path
        for name in _own_modules(slave):
            del sys.modules[name]
        sys.modules.update(before)


def _requirements(sources: Closure, compiled: bool, smooths: bool) -> str:
    """Text of requirements.txt: what the target must install, with the pins of the project.

    Args:
        sources: that travel.
        compiled: the engine travels compiled, so that the compiler is needed on other platforms only.
        smooths: a curve is smoothed where the FMU runs, by the library that `model.curves.measured` loads.

    Raises:
        MechanismError: a package that is no dependency of the project.
    """
    pins = {re.split(r"[^\w.-]", pin, maxsplit=1)[0]: pin for pin in dependencies()}
    needed = sources.external - _BROUGHT_ALONG | ({"scipy"} if smooths else set())
    for name in sorted(needed - pins.keys()):
        raise MechanismError(
            f"{sources.importers[name]}: the model imports {name}, which mechanism_fmu does not depend on; an FMU by "
            "pythonfmu can ask for nothing else. Remove the import, or build with --flavour native, for which only "
            "the numbers count."
        )
    note = f"# on other platforms than {', '.join(WRAPPED)} also:\n# {pins[_COMPILER]}\n" if compiled else ""
    return "".join(f"{pins[name]}\n" for name in sorted(needed - ({_COMPILER} if compiled else set()))) + note
