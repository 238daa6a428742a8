"""A mechanism in motion with the engine that is compiled ahead of time, so that it starts at once."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from ctypes import CDLL
from functools import cache
from threading import Timer

from ..engine import run
from ..fmu.native.objects import has_compiler, library_of
from ..model import Mechanism, MechanismError, compile_mechanism
from ..moving import MovingMechanism
from ..tables.layout import pack

#: Compiling that takes no longer is not worth a word [s].
_SILENT = 2.0


class Simulation(MovingMechanism):
    """One mechanism, from assembly through its motion.

    The engine is the one that the installation has compiled, or that the extra `dev` compiles after a change of its
    sources, in a minute or two, which it says, and keeps in the user's cache directory. Where that cannot be done, it
    is compiled just in time; with NUMBA_DISABLE_JIT=1 it runs as plain Python. The numbers are the same.

    Args:
        mechanism: its numbers are checked and written as tables.
        start_time: [s].
        inputs: values at the start in SI units, in the order of `mechanism.inputs`, one for each; their own start
            values by default.

    Raises:
        MechanismError: the mechanism cannot be right, or cannot be assembled (with what is left of each joint); or the
            values of inputs are too few, too many, or such as an input does not take.

    Source: Pennestrì, Valentini, Vita, eqs (1) to (4), (6) and (7); steps by Dormand and Prince, in E. Hairer, S. P.
        Nørsett, G. Wanner, Solving Ordinary Differential Equations I; equation by equation: docs/explanation/theory.md.
    """

    def __init__(
        self, mechanism: Mechanism, start_time: float = 0.0, inputs: Sequence[float | str] | None = None
    ) -> None:
        self._take(mechanism, pack(compile_mechanism(mechanism)), engine_here())
        self._begin_with(start_time, inputs)


def engine_here() -> CDLL | None:
    """The compiled engine; None: just in time.

    Raises:
        MechanismError: it is not there, and numba is not installed.
    """
    return run.compiled_library() or _made()


@cache
def _made() -> CDLL | None:
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return None
    progress = _Progress()
    try:
        library = library_of(progress.report)
    except MechanismError as error:
        if not has_compiler():
            raise
        _say(f"The engine is compiled just in time, which takes half a minute or more, as {error}")
        return None
    finally:
        progress.end()
    if library is None:
        _say(
            "The engine is compiled just in time, which takes each process half a minute or more: without the package "
            "ziglang it cannot be kept. Install it with: python -m pip install 'mechanism_fmu[native]'"
        )
    return library


class _Progress:
    """Says on stderr what is compiled, once that takes long."""

    def __init__(self) -> None:
        self._text = "it begins"
        self._speaks = False
        self._timer: Timer | None = None

    def report(self, text: str, done: float) -> None:
        """Take what comes next, and which part of the whole is done (0..1)."""
        self._text = f"{100 * done:.0f} %: {text}"
        if self._timer is None:
            self._timer = Timer(_SILENT, self._speak)
            self._timer.daemon = True
            self._timer.start()
        elif self._speaks:
            self._speak()

    def end(self) -> None:
        """Say no more."""
        if self._timer is not None:
            self._timer.cancel()
        if self._speaks:
            _say("The engine is compiled.")

    def _speak(self) -> None:
        self._speaks = True
        _say(f"The engine is compiled once for all platforms, {self._text} ...")


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
