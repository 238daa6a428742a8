"""Executor on a Dask cluster. Importing this needs the extra `cluster`."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

from distributed import Client, KilledWorker, as_completed, get_worker
from distributed.diagnostics.plugin import WorkerPlugin

from mechanism_fmu import __version__

from ..errors import HarnessError, UsageError
from ..fmu import open_fmu
from ..fmu.instances.workspace import temporary_folder
from ..run.master import never
from .task import Design, Result, Task
from .workers import Backend, Pairs, Work, portions

#: The scheduler must answer within [s].
_PATIENCE = 10

#: Fmpy changes the working folder of the whole process while it loads an FMU.
_one_at_a_time = threading.Lock()


@contextmanager
def connected(address: str) -> Iterator[Client]:
    """A client of the scheduler at an address such as "tcp://10.0.0.5:8786", whose workers have this same version.

    Raises:
        UsageError: nobody answers there, there is no worker, or one has no or another version of this package.
    """
    try:
        client = Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise UsageError(
            f"No scheduler answers at '{address}' ({error}). 'dask scheduler' starts one and prints its address."
        ) from error
    with client:
        _check_workers(client, address)
        yield client


def on_cluster(
    client: Client,
    fmu: Path,
    task: Task,
    way: Backend,
    designs: Iterable[Design],
    stop_requested: Callable[[], bool] = never,
) -> Iterator[Pairs]:
    """Run designs on all workers of a cluster, also on those that come later.

    The FMU travels with the task; each worker unpacks it once, and runs one portion of designs at a time. When a worker
    dies, Dask gives its designs to others; a design that some workers in a row have died of has failed.

    Raises:
        HarnessError: the cluster is lost. What has been yielded stays.
    """
    tools = _Tools(fmu, task, way)
    client.register_plugin(tools)
    waiting = portions(designs, way.together)
    running: dict[Any, list[Design]] = {}
    completed = as_completed(loop=client.loop)
    try:
        while True:
            if not stop_requested():
                for portion in islice(waiting, max(2 * sum(client.nthreads().values()) - len(running), 0)):
                    future = client.submit(_run_portion, tools.name, portion, pure=False)
                    running[future] = portion
                    completed.add(future)
            if not running:
                return
            yield [pair for future in completed.next_batch() for pair in _came(future, running.pop(future), tools)]
    except (OSError, CancelledError) as error:
        raise HarnessError(f"The cluster is lost: {error}. The same command goes on where it stopped.") from error
    finally:
        if client.status == "running":
            client.cancel(list(running))
            client.unregister_worker_plugin(tools.name)


def _came(future: Any, portion: list[Design], tools: _Tools) -> Pairs:
    try:
        pairs: Pairs = future.result()
    except KilledWorker as error:
        return [(design, Result.failed(design, tools.way.name, tools.task, str(error))) for design in portion]
    return pairs


class _Tools(WorkerPlugin):
    """What every worker gets once: the FMU, and what to do with it."""

    def __init__(self, fmu: Path, task: Task, way: Backend) -> None:
        self.name = f"mechanism_fmu-{id(self):x}"
        self.task, self.way = task, way
        self._file_name, self._content = fmu.name, fmu.read_bytes()
        self._kept: ExitStack | None = None
        self.work: Work | None = None

    def setup(self, worker: Any) -> None:
        """Unpack the FMU."""
        self._kept = ExitStack()
        path = self._kept.enter_context(temporary_folder()) / self._file_name
        path.write_bytes(self._content)
        self.work = Work(self._kept.enter_context(open_fmu(path)), self.task, self.way)

    def teardown(self, worker: Any) -> None:
        """Remove it."""
        if self._kept is not None:
            self._kept.close()


def _run_portion(name: str, designs: list[Design]) -> Pairs:
    work = get_worker().plugins[name].work
    with _one_at_a_time:
        pairs: Pairs = work.run(designs)
        return pairs


def _check_workers(client: Client, address: str) -> None:
    if not client.nthreads():
        raise UsageError(f"The scheduler has no workers yet. Start some: dask worker {address} --nthreads 1")
    try:
        versions = client.run(_version)
    except ImportError as error:
        raise UsageError(f"A worker of '{address}' lacks something: {error}. Install mechanism_fmu there.") from error
    for worker, version in versions.items():
        if version != __version__:
            raise UsageError(
                f"Worker {worker} has mechanism_fmu {version}, but here is {__version__}; install the same."
            )


def _version() -> str:
    return __version__
