"""Machine code by numba, made as whole programs and cached in files that are read only as they were written."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from llvmlite.binding import Linkage
from numba import types
from numba.core.caching import IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder

# Compile inner functions only as parts of the entry points that use them.
#
# Numba optimises, and turns into machine code, every function by itself together with all that it calls; with functions
# that call each other ten deep, most of that work is thrown away. Here an inner function stops at intermediate code,
# and each entry point is optimised and emitted once, as a whole program. Nothing else changes: the numbers are the same
# with and without this file. It leans on numba's internals, for which numba's minor series is pinned.


class _NoEnvironment:
    """Stands in for the code generator where numba would bind Python objects to machine code that does not exist."""

    def set_env(self, _name: str, _environment: Any) -> None:
        """Do nothing: the engine's functions use no Python object."""


class _InnerLibrary(JITCodeLibrary):
    """The intermediate code of a function, to be linked into programs and never to be run by itself.

    Its own alone: what it calls is added once, when a program is linked. In each caller's, as numba does it, a function
    ten deep would be copied ten times.
    """

    _shared_module: Any

    @property
    def codegen(self) -> _NoEnvironment:
        return _NoEnvironment()

    def get_pointer_to_function(self, _name: str) -> int:
        return 0

    def finalize(self) -> None:
        """Leave the code as it is."""
        self._finalized = True

    def _get_module_for_linking(self) -> Any:
        if self._shared_module is None:
            whole = self._own_code()
            for part in self._what_it_calls():
                code = part._own_code() if isinstance(part, _InnerLibrary) else part._get_module_for_linking()
                whole.link_in(code, preserve=True)
            _set_linkage(whole, Linkage.linkonce_odr)
            self._shared_module = whole
        return self._shared_module

    def _what_it_calls(self) -> list[Any]:
        """The libraries of all that it calls, and of what that calls, each once; numba's own are whole."""
        parts: dict[Any, None] = {}
        todo = list(self._linking_libraries)
        while todo:
            part = todo.pop()
            if part not in parts:
                parts[part] = None
                todo += part._linking_libraries if isinstance(part, _InnerLibrary) else ()
        return list(parts)

    def _own_code(self) -> Any:
        """A copy, of which nothing is lost before it is called."""
        module = self._final_module.clone()
        _set_linkage(module, Linkage.weak_odr)
        return module


def _set_linkage(module: Any, linkage: Linkage) -> None:
    """Let what a module defines be defined in other modules as well: weak, or gone where nothing calls it."""
    for function in module.functions:
        if not function.is_declaration and function.linkage in (Linkage.external, Linkage.weak_odr):
            function.linkage = linkage


class InnerCompiler(CompilerBase):
    """Numba's own pipeline, with an inner library as its product (`numba.njit(pipeline_class=...)`)."""

    def define_pipelines(self) -> list[Any]:
        """The usual pipeline."""
        return [DefaultPassBuilder.define_nopython_pipeline(self.state)]

    def compile_extra(self, func: Callable[..., Any]) -> Any:
        """Compile `func` into an inner library."""
        self.state.library = _InnerLibrary(self.state.targetctx.codegen(), func.__qualname__)
        return super().compile_extra(func)


def ignore_literals(inner: Any) -> None:
    """Compile a function once for each types of its arguments: numba would do so for each number that a call names."""
    resolve = inner.get_call_template

    def of_types(arguments: tuple[Any, ...], keywords: Mapping[str, Any]) -> Any:
        plain = {name: types.unliteral(argument) for name, argument in keywords.items()}
        return resolve(tuple(map(types.unliteral, arguments)), plain)

    inner.get_call_template = of_types


def refuse_python_calls(inner: Any) -> None:
    """Make calling a compiled inner function from Python an error instead of a jump to code that does not exist."""

    def refuse(*_arguments: Any, **_keywords: Any) -> None:
        raise TypeError(
            f"{inner.py_func.__qualname__} has no machine code of its own: only compiled functions can call it. "
            "Call it from a function that is decorated with `entry`."
        )

    inner._insert = lambda *_arguments, **_keywords: None
    inner._compile_for_args = refuse


# Machine code that numba keeps in files: each has its digest beside it, and one that does not fit is compiled again.
#
# Numba would unpickle whatever it finds: what a full disk has cut off stops it, and what was changed runs.


class CheckedFiles(IndexDataCacheFile):
    """Numba's index and data files of one function, read only as they were written."""

    def _load_index(self) -> Any:
        return super()._load_index() if _fits(self._index_path) else {}

    def _save_index(self, overloads: Any) -> None:
        super()._save_index(overloads)
        _sign(self._index_path)

    def _load_data(self, name: str) -> Any:
        path = self._data_path(name)
        if not _fits(path):
            raise OSError(f"{path} is not as it was written")  # numba then compiles
        return super()._load_data(name)

    def _save_data(self, name: str, data: Any) -> None:
        super()._save_data(name, data)
        _sign(self._data_path(name))


def check_files(function: Any) -> None:
    """Let a function that numba is to keep be read by `CheckedFiles`."""
    function._cache._cache_file.__class__ = CheckedFiles


def _digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def _sign(path: str) -> None:
    Path(f"{path}.sha256").write_text(_digest(path), encoding="ascii")


def _fits(path: str) -> bool:
    with suppress(OSError, ValueError):
        return Path(f"{path}.sha256").read_text(encoding="ascii") == _digest(path)
    return False
