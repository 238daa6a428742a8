"""Run one of the scripts beside this file in a Python process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

_HERE = Path(__file__).parent


def run_script(name: str, *arguments: str, **environment: str) -> Any:
    """What the script prints, from JSON; numba's settings are those of `environment` only."""
    inherited = {key: value for key, value in os.environ.items() if not key.startswith("NUMBA_")}
    path = os.pathsep.join([str(_HERE.parents[2]), inherited.get("PYTHONPATH", "")])
    run = subprocess.run(
        [sys.executable, str(_HERE / name), *arguments],
        env=inherited | {"PYTHONPATH": path} | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)
