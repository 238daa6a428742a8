"""A run's report with the engine inside: the model's page in a frame of its own, which begins with the run's values."""

from __future__ import annotations

from typing import Any

from mechanism_fmu.fmu.native.web import WebModule

from ..report.packed import packed_text
from ..report.page import section
from ..run.experiment import Run
from ..run.inputs import InputSignals
from ..run.results import settings
from .page_file import page
from .payload import script

HEADING = "Live: change a value"

#: Longer tables of inputs would make the page heavy.
_MOST_ROWS = 10_000

_NOTE = (
    "The engine itself, in this page: it begins with the parameters and inputs of this run, computes each change at "
    "once, and needs neither network nor installation."
)


def live_section(run: Run, web: WebModule) -> str:
    """The folded section; what is in it is unpacked when it unfolds.

    Args:
        run: whose values it begins with.
        web: the model of its FMU, as of `build_fmu.web_of`.

    Raises:
        MechanismError: as of `page`.
    """
    held = packed_text("live", page(web, case_of(run)))
    place = f'<div class="live-page" data-file="{web.model.name}_live.html"></div>{held}'
    return section(HEADING, place, script("frame.js"), note=f"{_NOTE}{_left_out(run.inputs)}", folded=True)


def no_live_section(reason: str) -> str:
    """A section that says why there is none."""
    return section(HEADING, note=f"Nothing here computes: {reason}.", folded=True)


def case_of(run: Run) -> dict[str, Any]:
    """The run as the case of a page: as those of `web_data.WebData`."""
    given = {variable.name for variable in run.description.of("parameter", "input")}
    signals = _signals(run.inputs)
    return {
        "name": "this_run",
        "description": "Parameters and inputs of the run of this report",
        "stop": run.experiment.stop_time,
        "step": run.experiment.step,
        "values": {
            name: value
            for name, value in settings(run).items()
            if name in given and name not in signals and not isinstance(value, str)
        },
        "signals": signals,
    }


def _signals(inputs: InputSignals | None) -> dict[str, Any]:
    """Tables of inputs over time that a page can follow: of Reals, between whose rows they are straight."""
    if inputs is None or len(inputs.times) > _MOST_ROWS:
        return {}
    return {
        variable.name: {"times": inputs.times.tolist(), "values": inputs.values[:, place].tolist()}
        for place, variable in enumerate(inputs.variables)
        if variable.type == "Real"
    }


def _left_out(inputs: InputSignals | None) -> str:
    names = [] if inputs is None else [v.name for v in inputs.variables if v.name not in _signals(inputs)]
    return f" Kept at their first values, not as in the table: {', '.join(names)}." if names else ""
