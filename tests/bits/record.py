"""One FMU run by FMPy alone, and all that it gives kept as it is; a process of its own for each.

python -m tests.bits.record FMU RESULT.npz
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import fmpy
import numpy as np

#: Steps of the default experiment, and how far inputs swing about their start values.
STEPS = 400
SWING = 0.05


def record(fmu: Path) -> dict[str, Any]:
    """Everything that an FMU gives in two runs, of its start values and with inputs that swing, as arrays by name.

    A run that fails has its message instead.
    """
    description = fmpy.read_model_description(str(fmu))
    stop = float(description.defaultExperiment.stopTime)
    named = {variable.name: variable for variable in description.modelVariables}
    outputs = [name for name, v in named.items() if v.causality in ("output", "local", "calculatedParameter")]
    outputs = [name for name in outputs if named[name].type not in ("Clock", "String") and not named[name].dimensions]
    # FMPy reads outputs in step mode, where those of a clock cannot be read; each has a twin that can.
    outputs = [name for name in outputs if not named[name].clocks]
    inputs = [
        v for v in named.values() if v.causality == "input" and v.type in ("Real", "Float64") and not v.dimensions
    ]
    events = {"early_return_allowed": True, "use_event_mode": True} if description.fmiVersion != "2.0" else {}
    found: dict[str, Any] = {}
    for run, signal in (("start values", None), ("inputs", swinging(inputs, stop))):
        try:
            rows = fmpy.simulate_fmu(
                str(fmu),
                stop_time=stop,
                output_interval=stop / STEPS,
                input=signal,
                output=outputs,
                fmi_type="CoSimulation",
                **events,
            )
        except Exception as trouble:  # any: what went wrong is what is compared
            found[f"{run}: message"] = np.array(str(trouble))
            continue
        for name in rows.dtype.names:
            found[f"{run}: {name}"] = rows[name].copy()
    return found


def swinging(inputs: list[Any], stop: float) -> np.ndarray[Any, Any] | None:
    """A table of all inputs, each swinging about its start value with a frequency of its own; None without any."""
    if not inputs:
        return None
    time = np.linspace(0.0, stop, 101)
    table = np.zeros(len(time), dtype=[("time", float), *((v.name, float) for v in inputs)])
    table["time"] = time
    for number, variable in enumerate(inputs, start=1):
        start = float(variable.start or 0.0)
        table[variable.name] = start + SWING * max(abs(start), SWING) * np.sin(2.0 * np.pi * number * time / stop)
    return table


if __name__ == "__main__":
    np.savez(sys.argv[2], **record(Path(sys.argv[1])))
