"""Starts the slave of an FMU: this file travels in the FMU and is the first of it to run.

It stands alone (standard library only), because it decides from where everything else is imported. The package
beside it is not imported in place: an FMU is unzipped to a new folder each time, and compiled code is cached by
path. Instead its files are copied to a folder of the user's cache directory that is named after their contents, so
that the second start finds what the first one compiled.
"""

from __future__ import annotations

import _ctypes
import atexit
import ctypes
import hashlib
import importlib
import importlib.util
import os
import shutil
import sys
import tempfile
import warnings
from functools import cache
from importlib.machinery import SOURCE_SUFFIXES, FileFinder, SourceFileLoader
from pathlib import Path

#: Environment variable with the folder to use instead of the user's cache directory.
CACHE_VARIABLE = "MECHANISM_FMU_CACHE"

_RESOURCES = Path(__file__).parent

#: Sources, and the engine's library for each platform.
_COPIED = {".py", ".so", ".dll", ".dylib"}

#: By the folder in the cache: where the FMU has the same files, and beside them what was compiled when it was built.
_shipped: dict[str, Path] = {}

#: Bytes of a SHA-256.
_DIGEST_SIZE = 32

#: How often the cache is tried that somebody deletes meanwhile.
_TRIED = 2

#: Oldest Python that the package runs on.
_PYTHON = (3, 11)

#: The wrapper's entry on `sys.path`.
_entry: str | None = None


@cache
def slave_class(
    package: str,
    model: str,
    starts: tuple[tuple[str, float], ...] = (),
    inputs: tuple[tuple[str, tuple[object, ...]], ...] = (),
) -> type:
    """The slave class of the FMU.

    Args:
        package: name of the package beside this file, which no other contents have.
        model: module of the package, relative to it, that holds `MODEL`.
        starts: names and start values that this FMU has as its own.
        inputs: names of those that are given otherwise than in the model, with factor, offset and unit.

    Raises:
        ImportError: Python is too old, or a package is missing; the message says what to install.
    """
    if sys.version_info < _PYTHON:
        needed = ".".join(map(str, _PYTHON))
        raise _refusal(f"it needs Python {needed} or later; this is {sys.version.split()[0]}.")
    try:
        for _ in range(_TRIED):
            folder = _cached(_RESOURCES / package)
            try:
                made = _made(folder, package, model, starts, inputs)
                if _has_engine(folder, _RESOURCES / package):
                    return made
            except (ImportError, FileNotFoundError) as error:
                others = isinstance(error, ImportError) and f"{error.name}.".partition(".")[0] != package
                if others and _has_engine(folder, _RESOURCES / package):
                    raise
            # Somebody has deleted the cache while it was read: once more, from a folder that is written anew.
            for name in [name for name in sys.modules if name == package or name.startswith(f"{package}.")]:
                del sys.modules[name]
        # It goes as fast as it is written, and takes long to go where the machine is busy: from the FMU itself.
        return _made(_RESOURCES / package, package, model, starts, inputs)
    except ModuleNotFoundError as error:
        lines = (_RESOURCES / "requirements.txt").read_text(encoding="utf-8").splitlines()
        # Of the comments, those that are no sentence are packages for platforms without a compiled engine.
        requirements = [line.removeprefix("# ") for line in lines if not line.endswith(":")]
        install = f"python -m pip install {' '.join(map(repr, requirements))}"
        raise _refusal(f"there is no {error.name}. Install what it needs with: {install}") from error


def _made(
    folder: Path,
    package: str,
    model: str,
    starts: tuple[tuple[str, float], ...],
    inputs: tuple[tuple[str, tuple[object, ...]], ...],
) -> type:
    """As `slave_class`, from the package in a folder.

    Raises:
        FileNotFoundError: the folder has gone meanwhile; or ImportError, of its modules.
    """
    _shipped[str(folder)] = _RESOURCES / package
    _import_package(package, folder)
    slave = importlib.import_module(f"{package}.fmu.instance.slave")
    described = importlib.import_module(f"{package}.{model}").MODEL
    if starts or inputs:
        baked = importlib.import_module(f"{package}.model.baked")
        seen = {name: baked.Seen(*given) for name, given in inputs}
        described = baked.baked_model(described, baked.Baked(dict(starts), seen))
    made: type = slave.make_slave_class(described)
    return made


def _has_engine(folder: Path, source: Path) -> bool:
    """Whether a copy still has the compiled engine that its source has, if any.

    If so after the class was made, the engine has been loaded, and stays; if not, it would be compiled, from sources
    that have gone, too.
    """
    libraries = (source / "engine" / "compiled").glob("*")
    return all((folder / library.relative_to(source)).is_file() for library in libraries)


def _refusal(reason: str) -> ImportError:
    message = f"The FMU cannot run in the Python of {sys.prefix}: {reason}"
    # The wrapper passes the error on to the host's log only if the host has asked for one.
    print(message, file=sys.stderr)
    return ImportError(message)


def tidy_up(slave_globals: dict[str, object]) -> None:
    """Make good what pythonfmu's wrapper does wrong; to be called at the end of the slave file.

    The wrapper (PySlaveInstance.cpp of pythonfmu 0.7.0) runs the slave file at every instantiation. Each time it
    releases a reference to the module's globals that it does not own, which would free them while in use, and puts
    the FMU's resources at the front of `sys.path` once more. For the third fault see `_release_interpreter_once`.

    Args:
        slave_globals: `globals()` of the slave file.
    """
    global _entry
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(slave_globals))
    newest = sys.path[0]
    if not os.path.isfile(os.path.join(newest, f"{slave_globals['__name__']}.py")):
        return
    # The newest entry stays: pythonfmu's builder removes the one that it has put there, and fails if it is gone.
    sys.path[1:] = [entry for entry in sys.path[1:] if entry not in (newest, _entry)]
    if sys.platform == "linux":
        _release_interpreter_once(Path(newest).parent, known=newest == _entry)
    _entry = newest


def _release_interpreter_once(fmu: Path, known: bool) -> None:
    """Make the wrapper release the Python interpreter once; by itself it does so twice.

    Its static destructor releases it at exit or when the library is unloaded, and afterwards the exported function
    `finalizePythonInterpreter` releases it again, in memory that is already free: hosts abort at exit with a corrupted
    heap. When that function is called first, it leaves nothing behind that could be released.
    """
    for path in (fmu / "binaries" / "linux64").glob("*.so"):
        try:
            wrapper = ctypes.CDLL(str(path), os.RTLD_NOLOAD | os.RTLD_NOW)
        except OSError:
            continue  # not loaded: somebody else's instance
        if sys.orig_argv:
            # A Python host: what the wrapper holds is empty, because the interpreter was there before.
            wrapper.finalizePythonInterpreter()
            _ctypes.dlclose(wrapper._handle)
        elif not known:
            # Any other host needs the interpreter to the end. What is registered last is called first at exit.
            ctypes.CDLL(None).__cxa_atexit(wrapper.finalizePythonInterpreter, None, None)


def _cached(source: Path) -> Path:
    """A folder outside the FMU with the files of `source`."""
    try:
        folder = private_cache() / source.name
        _synchronize(source, folder)
        if not os.access(folder, os.W_OK):
            raise PermissionError(f"{folder} is read-only")
    except (OSError, RuntimeError) as error:
        folder = Path(tempfile.mkdtemp(prefix="mechanism_fmu_")) / source.name
        atexit.register(shutil.rmtree, folder.parent, ignore_errors=True)
        _synchronize(source, folder)
        warnings.warn(
            f"The cache directory cannot be used ({error}), so the engine is compiled again in every process. "
            f"Set the environment variable {CACHE_VARIABLE} to a folder that you alone can write.",
            RuntimeWarning,
            stacklevel=3,
        )
    return folder


def cache_directory() -> Path:
    """Where the operating system wants caches of the user (XDG Base Directory Specification on Linux)."""
    if chosen := os.environ.get(CACHE_VARIABLE):
        return Path(chosen).absolute()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache").absolute()


def private_cache() -> Path:
    """The folder of this project in the cache directory, made if need be; nobody else can write to it.

    What lies there is run. On Windows, the user's folders are nobody else's anyway.

    Raises:
        OSError: it cannot be made, or somebody else can write to it; the message says the way out.
    """
    folder = cache_directory() / "mechanism_fmu"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    if hasattr(os, "geteuid"):
        state = folder.stat()
        if state.st_uid != os.geteuid():
            whose = f"belongs to user {state.st_uid}, not to {os.geteuid()} who runs this"
        elif state.st_mode & 0o022:
            whose = f"can be written by others (mode {state.st_mode & 0o777:o})"
        else:
            return folder
        raise PermissionError(
            f"the folder '{folder}', whose contents are run, {whose}; delete it, or, if you trust what is in it, make "
            f"it yours alone (chown, chmod go-w), or set {CACHE_VARIABLE} to another folder"
        )
    return folder


def _synchronize(source: Path, folder: Path) -> None:
    """Make every file of `source` stand in `folder` with the same bytes.

    Whatever is missing or damaged is written anew. Each file appears by one atomic rename and is only ever given the
    same contents, so that any number of processes may do this at once.
    """
    for original in sorted(path for path in source.rglob("*") if path.suffix in _COPIED):
        contents = original.read_bytes()
        copy = folder / original.relative_to(source)
        try:
            if copy.read_bytes() == contents:
                continue
        except OSError:
            copy.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=copy.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(contents)
            os.chmod(temporary, 0o644)
            os.replace(temporary, copy)
        except BaseException:
            os.unlink(temporary)
            raise


def _import_package(name: str, folder: Path) -> None:
    """Import a package from a folder that need not be on `sys.path`."""
    if name in sys.modules:
        return
    import_checked(folder)
    first = folder / "__init__.py"
    spec = importlib.util.spec_from_file_location(
        name, first, loader=CheckedLoader(name, str(first)), submodule_search_locations=[str(folder)]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"{folder} holds no package")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise


class CheckedLoader(SourceFileLoader):
    """Imports sources; what Python keeps compiled (.pyc) ends with a digest, and is compiled again if it does not fit.

    Python itself looks at date and size of the source only: what a full disk has cut off ends each import from then on,
    and what was changed runs.
    """

    def get_data(self, path: str) -> bytes:
        """The bytes of a source, or of compiled code without its digest.

        Raises:
            OSError: there are none that fit; Python then compiles the source.
        """
        if path.endswith(tuple(SOURCE_SUFFIXES)):
            return super().get_data(path)
        try:
            return _whole(super().get_data(path), path)
        except OSError:
            for folder, origin in _shipped.items():
                if Path(path).is_relative_to(folder):
                    return _whole(super().get_data(str(origin / Path(path).relative_to(folder))), path)
            raise

    def set_data(self, path: str, data: bytes, *, _mode: int = 0o666) -> None:  # type: ignore[override]
        """Keep compiled code."""
        super().set_data(path, bytes(data) + hashlib.sha256(data).digest(), _mode=_mode)


def _whole(data: bytes, path: str) -> bytes:
    """Compiled code without its digest, which must fit."""
    code, digest = data[:-_DIGEST_SIZE], data[-_DIGEST_SIZE:]
    if hashlib.sha256(code).digest() != digest:
        raise OSError(f"{path} is not as it was written")
    return code


def import_checked(folder: Path) -> None:
    """Let Python import from a folder and those in it by `CheckedLoader`, and nothing but sources."""
    for place in (folder, *folder.rglob("*")):
        if place.is_dir():
            sys.path_importer_cache[str(place)] = FileFinder(str(place), (CheckedLoader, SOURCE_SUFFIXES))
