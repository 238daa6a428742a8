"""Times one start of an unzipped FMU, in a process that has done nothing before: `python -m benchmarks.start FOLDER`.

Prints JSON: `process`, the time since before fmpy was imported, and `instance`, since before the instantiation, both
to the end of the initialization [s]; `cpu`, the processor time that goes with `process` [s]; and `wheel_angle` after
one step [rad].
"""

from __future__ import annotations

import json
import sys
from time import perf_counter, process_time


def main(folder: str) -> None:
    """Start the FMU in `folder`."""
    began, cpu_began = perf_counter(), process_time()
    from fmpy import read_model_description
    from fmpy.fmi2 import FMU2Slave

    description = read_model_description(folder)
    instance_began = perf_counter()
    identifier = description.coSimulation.modelIdentifier
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName=identifier)
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    ready, cpu_ready = perf_counter(), process_time()
    fmu.doStep(0.0, 1e-3)
    wheel = next(v.valueReference for v in description.modelVariables if v.name == "wheel_angle")
    found = {
        "process": ready - began,
        "instance": ready - instance_began,
        "cpu": cpu_ready - cpu_began,
        "wheel_angle": fmu.getReal([wheel])[0],
    }
    fmu.terminate()
    fmu.freeInstance()
    print(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1])
