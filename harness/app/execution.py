"""Execution of a command: signals and interruption, lock of its folder, processes of their own for foreign FMUs."""

from __future__ import annotations

import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import FrameType

import typer

from mechanism_fmu.fmu.disk.user_cache import alone, was_built_here

from ..errors import UsageError
from ..fmu import Fmu
from ..fmu.interface import Instances
from ..fmu.remote import RemoteFmu
from ..run.master import never
from ..run.results import prepare_folder, sweep_up
from .terminal import FAILED, console, show_error, show_note, user_errors

# Ctrl-C and SIGTERM as polite requests.

#: Ctrl-C, and what a system sends to what it ends.
_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def interruption(on_request: Callable[[], None]) -> Iterator[Callable[[], bool]]:
    """Turn the first Ctrl-C or SIGTERM into a request that the run can ask for; the second one acts as usual.

    An exception would not do: inside an FMU written in Python it would end up as a failure of the FMU.

    Args:
        on_request: called at the first of them.

    Yields:
        A function that says whether there was one. Outside the main thread, where Python delivers no
        signals, it is always false.
    """
    if threading.current_thread() is not threading.main_thread():
        yield never
        return
    requested = False
    usual = {number: signal.getsignal(number) for number in _SIGNALS}

    def as_usual() -> None:
        for number, handler in usual.items():
            signal.signal(number, handler)

    def handle(_signal: int, _frame: FrameType | None) -> None:
        nonlocal requested
        requested = True
        as_usual()
        on_request()

    for number in _SIGNALS:
        signal.signal(number, handle)
    try:
        yield lambda: requested
    finally:
        as_usual()


# One command at a time in a folder of results.


@contextmanager
def alone_in(folder: Path, waits: bool = True) -> Iterator[None]:
    """Make a folder if need be, and be the only command that works in it; what a killed one left there goes.

    Args:
        folder: for the results.
        waits: for another command, which is said; else it is refused.

    Raises:
        UsageError: it cannot be made, its lock cannot be opened, or another command is at work and nobody waits.
    """

    def occupied() -> None:
        if not waits:
            raise UsageError(
                f"Another command is at work in '{folder}', and two would mix their files. Choose another folder with "
                "-o, or try again when it is done."
            )
        console.print(f"Another command is at work in {folder}: waiting for it.", markup=False)

    prepare_folder(folder)
    with ExitStack() as stack:
        try:
            stack.enter_context(alone(folder, occupied))
        except OSError as error:
            raise UsageError(
                f"'{folder / '.lock'}' cannot be opened ({error}): perhaps somebody else made it. Remove it, or choose "
                "another folder with -o."
            ) from error
        sweep_up(folder)
        yield


# Where instances of an FMU live: here, or in processes of their own (docs/decisions/028-whose-fmu-runs-where.md).
#
# An FMU is code of whoever made it. In the own process it can end that, with whatever exit code it likes, move its
# working folder, or overwrite its memory. So only a file that this user's builds have made runs here.

#: Of a call [s]; nobody else ends a step of hours.
LONG_TIME_LIMIT = 600.0


def instances_of(fmu: Fmu) -> Instances:
    """An FMU itself if a build of this user has made it, else one whose instances have processes of their own."""
    return fmu if was_built_here(fmu.path) else RemoteFmu(fmu, LONG_TIME_LIMIT)


def with_instances(fmu: Fmu, in_process: bool, work: Callable[[Instances], int]) -> int:
    """The exit code of work with instances of an FMU.

    Args:
        fmu: extracted.
        in_process: whether instances shall be in the process that works, though no build of this user has made the FMU.
        work: is given what makes instances, and returns an exit code.
    """
    instances = instances_of(fmu)
    if instances is fmu or in_process:
        return watched(lambda: work(fmu), instances is not fmu)
    show_note(
        f"{fmu.path.name} runs in a process of its own, as no build of yours has made it; --in-process runs it here, "
        "faster by a round trip a step."
    )
    return work(instances)


def watched(work: Callable[[], int], foreign: bool) -> int:
    """The exit code of work; `supervised` where it runs a foreign FMU in its own process and the system can do so."""
    return supervised(work) if foreign and hasattr(os, "fork") else work()


def supervised(work: Callable[[], int]) -> int:
    """The exit code of work that is done in a copy of this process, whose every other end is a failure.

    Who runs foreign code in its own process cannot promise how that ends: `exit(0)` there would look like success. Not
    on Windows, which has no copies of processes.
    """
    reader, writer = os.pipe()
    alive, stay = os.pipe()
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)  # Ctrl-C comes once: from below
        os.close(reader)
        os.close(stay)
        _end_with(alive)
        code = _code_of(work)
        os.write(writer, bytes([code]))
        os._exit(code)
    os.close(writer)
    os.close(alive)
    passed_on = signal.SIGINT, signal.SIGTERM
    before = {number: signal.signal(number, lambda n, _: os.kill(child, n)) for number in passed_on}
    try:
        _, status = os.waitpid(child, 0)
        asked_for = os.read(reader, 1)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        os.close(reader)
        os.close(stay)
    code = os.waitstatus_to_exitcode(status)
    if asked_for and code == asked_for[0]:
        return code
    how = f"by the signal {signal.Signals(-code).name}" if code < 0 else f"with exit code {code}"
    show_error(
        f"The process ended {how} before the program did: the FMU crashed or ended it. What is in no file is lost; "
        "without --in-process (or process = false in a machine's file), an FMU of others has a process of its own."
    )
    return FAILED


def _code_of(work: Callable[[], int]) -> int:
    """The exit code of work, with everything that is to be said of it."""
    try:
        with user_errors():
            code = work()
    except typer.Exit as end:
        code = end.exit_code
    except BaseException:
        traceback.print_exc()
        code = FAILED
    sys.stdout.flush()
    sys.stderr.flush()
    return code


def _end_with(alive: int) -> None:
    """End this process when the other end of a pipe is closed: its process was killed."""

    def wait() -> None:
        os.read(alive, 1)
        os._exit(FAILED)

    threading.Thread(target=wait, daemon=True).start()


def require_writable(output: Path | None, kinds: Sequence[str]) -> None:
    """Refuse a file before there is anything to write into it: one of another kind, or without a folder.

    Args:
        output: the file, or None.
        kinds: how its name may end, as ".csv".

    Raises:
        UsageError: it cannot be written.
    """
    if output is None:
        return
    if output.suffix not in kinds:
        raise UsageError(f"{output.name} ends in {output.suffix!r}; give a file that ends in {' or '.join(kinds)}.")
    if not output.absolute().parent.is_dir():
        raise UsageError(f"There is no folder '{output.absolute().parent}' to write {output.name} into; make it first.")
