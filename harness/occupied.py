"""One command at a time in a folder of results."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from mechanism_fmu.fmu.native.alone import alone

from .errors import UsageError
from .results import prepare_folder, sweep_up
from .terminal import console


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
