"""FMPy's own simulation loop."""

from __future__ import annotations

from tests.importers.asked import Asked
from tests.importers.tool import Tool, Values, package_missing, package_version


def run(asked: Asked) -> Values:
    from fmpy import simulate_fmu

    events = {"use_event_mode": True, "early_return_allowed": True} if asked.event_mode else {}
    found = simulate_fmu(
        asked.fmu,
        stop_time=asked.stop,
        step_size=asked.step,
        output_interval=asked.step,
        output=asked.names(),
        **events,
    )
    assert abs(found["time"][-1] - asked.stop) < 1e-9
    return {name: float(found[name][-1]) for name in asked.names()}


TOOL = Tool(
    "FMPy",
    ("fmi2", "fmi3", "fmi3_events", "clocks", "pythonfmu"),
    run,
    lambda: package_missing("fmpy", "fmpy"),
    lambda: package_version("fmpy"),
)
