"""A command in a process of its own, watched while it runs."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from tests.faults.commands import Command, Recorded

ROOT = Path(__file__).parents[2]
_PROGRAM = "from harness.app.cli import main; main()"
#: Nothing here takes so long [s], though the machine is busy otherwise: even the engine is compiled in less.
_PATIENCE = 1200.0
_GLANCE = 0.05


@dataclass(frozen=True)
class Place:
    """Where a trial takes place.

    Attributes:
        folder: of everything else here.
        cache: `MECHANISM_FMU_CACHE`.
        environment: more of it.
        before: called in the new process before the command is, as limits and users are set.
        console: where it prints; None: into a file in `folder`.
        name: of the command, where there are two.
    """

    folder: Path
    cache: Path | None = None
    environment: Mapping[str, str] = field(default_factory=dict)
    before: Callable[[], None] | None = None
    console: Path | None = None
    name: str = ""

    @property
    def results(self) -> Path:
        """Folder of the command's results."""
        return self.folder / "results"

    @property
    def temporary(self) -> Path:
        """Folder of its temporary files; it is kept apart for what is left in it."""
        return self.folder / "tmp"


class Running:
    """A command at work, to be used in a `with`: whatever it is, it has ended afterwards.

    Attributes:
        seen: what it had recorded whenever somebody looked.
        largest: size of its address space, at most [bytes].
        took: its time, when it has ended [s].
    """

    def __init__(self, command: Command, place: Place) -> None:
        place.temporary.mkdir(parents=True, exist_ok=True)
        place.temporary.chmod(0o1777)
        self.command, self.place = command, place
        self.seen: Recorded = {}
        self.largest = 0
        self.took = 0.0
        self._files = [
            place.folder / f"{place.name}errors.txt",
            place.console or place.folder / f"{place.name}console.txt",
        ]
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "500", "TMPDIR": str(place.temporary)}
        environment |= {"OPENBLAS_NUM_THREADS": "1", **place.environment}
        if place.cache is not None:
            environment["MECHANISM_FMU_CACHE"] = str(place.cache)
        arguments = [*command.write(place.folder), "-o", str(place.results)]
        self.began = time.monotonic()
        with self._files[0].open("w") as errors, self._files[1].open("w") as console:
            self.process = subprocess.Popen(
                [sys.executable, "-c", _PROGRAM, *arguments],
                stdin=subprocess.DEVNULL,
                stdout=console,
                stderr=errors,
                env=environment,
                cwd=place.folder,
                preexec_fn=place.before,
                start_new_session=True,
            )

    def __enter__(self) -> Running:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.wait()

    @property
    def at_work(self) -> bool:
        """Whether it has not ended."""
        return self.process.poll() is None

    def look(self) -> None:
        """See what it has recorded."""
        with suppress(FileNotFoundError):  # put together with others, or done, since it was found
            self.seen |= self.command.recorded(self.place.results)
        with suppress(OSError, IndexError):  # no such files here, or the process is gone
            status = Path(f"/proc/{self.process.pid}/status").read_text()
            self.largest = max(self.largest, int(status.partition("VmPeak:")[2].split()[0]) * 1024)

    def until(self, moment: float, results: int = 0) -> bool:
        """Look on until so many seconds after its beginning, and so many results; whether it is still at work."""
        while self.at_work and (time.monotonic() < self.began + moment or len(self.seen) < results):
            self.look()
            time.sleep(_GLANCE)
        self.look()
        return self.at_work

    def end(self, patience: float = _PATIENCE) -> int:
        """Look on until it ends, so many seconds at the most; its exit code, negative for a signal.

        Raises:
            TimeoutError: it does not.
        """
        if self.until(patience):
            raise TimeoutError(f"{self.command.name} has not ended in {patience:.0f} s")
        self.took = time.monotonic() - self.began
        return int(self.process.wait())

    def errors(self) -> str:
        """What it has printed as an error."""
        return self._files[0].read_text(encoding="utf-8", errors="replace")

    def words(self) -> str:
        """All that it has printed, errors first."""
        return "".join(file.read_text(encoding="utf-8", errors="replace") for file in self._files if file.is_file())
