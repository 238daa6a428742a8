"""Machines run by others."""

import importlib.util
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from harness.machine.file.machine_plan import Plan
from tests.harness.machine.machines import SIGNALS, references


def in_fmpy() -> ModuleType:
    """The example that runs an SSP file in fmpy, as a module."""
    path = Path(__file__).parents[3] / "docs" / "examples" / "ssp_in_fmpy.py"
    spec = importlib.util.spec_from_file_location("ssp_in_fmpy", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def in_libcosim(ssp: Path, plan: Plan, steps: int, signals: Sequence[str] = SIGNALS) -> np.ndarray:
    """Real outputs after each step, shape (steps, signals)."""
    pytest.importorskip("libcosimpy", reason="libcosimpy is not installed")
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_ssp_file(str(ssp))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer)
    places = {info.name.decode(): info.index for info in execution.slave_infos()}
    known = references(plan, signals)
    rows = []
    for _ in range(steps):
        assert execution.step()
        ends = (known[name] for name in signals)
        rows.append([observer.last_real_values(places[part], [reference])[0] for part, reference in ends])
    return np.array(rows)
