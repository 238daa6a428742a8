"""libcosim, the Open Simulation Platform's co-simulation engine, by its package libcosimpy: fixed steps."""

from __future__ import annotations

from tests.importers.asked import Asked
from tests.importers.tool import Tool, Values, package_missing, package_version


def run(asked: Asked) -> Values:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    log_output_level(CosimLogLevel.WARNING)
    nanoseconds = round(asked.step * 1e9)
    execution = CosimExecution.from_step_size(step_size=nanoseconds)
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=asked.fmu, instance_name="one"))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer=observer)
    assert execution.step(asked.steps)
    assert execution.status().current_time == asked.steps * nanoseconds
    values: Values = {}
    for kind in ("real", "integer", "boolean"):
        outputs = asked.of_kind(kind)
        if outputs:
            read = getattr(observer, f"last_{kind}_values")
            found = read(slave, [output.reference for output in outputs])
            values |= {output.name: float(value) for output, value in zip(outputs, found, strict=True)}
    return values


TOOL = Tool(
    "libcosim (libcosimpy)",
    ("fmi2", "pythonfmu"),
    run,
    lambda: package_missing("libcosimpy", "libcosimpy"),
    lambda: package_version("libcosimpy"),
    "it takes FMI 1.0 and 2.0",
)
