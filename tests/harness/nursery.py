"""The command in a process of its own, without its imports each time: all are copies of one that has done them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

#: It has no threads, which copies would not have: numpy's libraries are told so.
_PROGRAM = """
import json, os, sys
from harness.app.cli import main
import harness.app.commands.one_run, harness.report.run_report

for line in sys.stdin:
    asked = json.loads(line)
    child = os.fork()
    if child:
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
        continue
    os.environ.update(asked["environment"])
    for descriptor, path in enumerate((os.devnull, asked["out"], asked["err"])):
        os.dup2(os.open(path, os.O_RDWR | os.O_CREAT), descriptor)
    sys.argv = ["mechanism-fmu", *asked["arguments"]]
    main()
"""


class Ended(NamedTuple):
    """How a process has ended: its code, negative for a signal, and all that it has said."""

    code: int
    out: str
    err: str


class Nursery:
    """Where processes come from, as `nursery` gives it."""

    def __init__(self, process: subprocess.Popen[str], variables: dict[str, str]) -> None:
        self._process, self._variables = process, variables

    def run(self, arguments: Sequence[str], **environment: str) -> Ended:
        """Run the command with arguments, and variables of its environment."""
        if not hasattr(os, "fork"):
            command = [sys.executable, "-c", "from harness.app.cli import main; main()", *arguments]
            done = subprocess.run(command, env=self._variables | environment, capture_output=True, text=True)
            return Ended(done.returncode, done.stdout, done.stderr)
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder, name) for name in ("out", "err")]
            asked = {"arguments": arguments, "environment": environment, "out": str(files[0]), "err": str(files[1])}
            self._process.stdin.write(json.dumps(asked) + "\n")
            self._process.stdin.flush()
            code = int(self._process.stdout.readline())
            return Ended(code, *(file.read_text(encoding="utf-8") for file in files))


@contextmanager
def nursery(**environment: str) -> Iterator[Nursery]:
    """Processes whose environment has these variables from the start."""
    variables = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"} | environment
    with subprocess.Popen(
        [sys.executable, "-c", _PROGRAM], env=variables, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        yield Nursery(process, variables)
