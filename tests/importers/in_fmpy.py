"""FMPy's own simulation loop."""

from __future__ import annotations

from typing import Any

from tests.importers.asked import Asked
from tests.importers.tool import Tool, Values, package_missing, package_version


def run(asked: Asked) -> Values:
    from fmpy import simulate_fmu

    how: dict[str, Any] = {"fmi_type": "CoSimulation"}
    if asked.event_mode:
        how |= {"use_event_mode": True, "early_return_allowed": True}
    if asked.exchange:
        how = {"fmi_type": "ModelExchange", "relative_tolerance": 1e-10}
    found = simulate_fmu(
        asked.fmu,
        stop_time=asked.stop,
        step_size=asked.step,
        output_interval=asked.step,
        output=asked.names(),
        **how,
    )
    assert abs(found["time"][-1] - asked.stop) < 1e-9
    return {name: float(found[name][-1]) for name in asked.names()}


TOOL = Tool(
    "FMPy",
    ("fmi2", "fmi3", "fmi3_events", "clocks", "pythonfmu", "exchange2", "exchange3"),
    run,
    lambda: package_missing("fmpy", "fmpy"),
    lambda: package_version("fmpy"),
)
