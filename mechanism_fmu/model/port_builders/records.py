"""Outputs that report impacts and events: of the last one, and of all those of the last communication step.

What is reported of one impact is a tuple of fields. A field is an `Output` without its place: the name is that after
"impact_" or "impacts[k].", the source that after "impact." or "impacts[k]." (see `Output`), and "{impact}" in the
description is replaced by which impact it is:

    Output("cam_speed", "speed:cam", "Speed of the cam just after, {impact}", "rad/s", "rpm")
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...codes import EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH, MOST_KEPT
from ..errors import MechanismError
from ..ports import Output
from .outputs import flag_output, speed_output, whole_output

_STEP = "of the last communication step"


def impact_outputs(what: str, fields: Sequence[Output], kept: int = IMPACT_BUFFER_LENGTH) -> tuple[Output, ...]:
    """Counters of impacts, the last one, and those of the last communication step, from which runs make tables.

    Args:
        what: whose impacts, e.g. "Impacts of the driver on its backstop".
        fields: what is reported of each, with "{impact}" in the descriptions, besides its time, its instant (a counter:
            all impacts of one instant have the same) and the energy that all impacts of this instant lost [J].
        kept: how many impacts of a step are kept, 8 to 1000.

    Raises:
        MechanismError: as many cannot be kept.
    """
    time = Output("time", "time", "Time, {impact}", "s")
    instant = whole_output("instant", "instant", "Number of the instant, the same for all its impacts, {impact}")
    lost = Output("energy_lost", "energy_lost", "Energy lost at the instant, {impact}", "J")
    fields = (*fields, lost)
    return (*last_impact_outputs(what, fields), *impact_buffer_outputs((time, instant, *fields), kept))


def impact_speed_fields(*bodies: str, nominal: float = 1.0) -> tuple[Output, ...]:
    """Fields <body>_speed_before and <body>_speed [rad/s]: of bodies, just before and after the instant of an impact.

    Args:
        bodies: names.
        nominal: a typical speed [rad/s].
    """
    moments = (("_before", "before"), ("", "after"))
    return tuple(
        speed_output(
            f"{body}_speed{suffix}",
            f"speed{suffix}:{body}",
            f"Speed of the {body} just {moment} the instant: {{impact}}",
            nominal,
        )
        for suffix, moment in moments
        for body in bodies
    )


def last_impact_outputs(what: str, fields: Sequence[Output]) -> tuple[Output, ...]:
    """Counter of impacts, whether there was one in the last step, and time [s] and fields of the last one.

    Args:
        what: as of `impact_outputs`.
        fields: as of `impact_outputs`.
    """
    return (
        whole_output("impact_count", "impact.count", f"{what} since the start"),
        flag_output("impact", "impact.any", f"At least one impact in {_STEP.removeprefix('of ')}"),
        Output("impact_time", "impact.time", "Time of the last impact; -1 before the first", "s"),
        *(_placed(field, "impact_", "impact.", "last impact") for field in fields),
    )


def impact_buffer_outputs(fields: Sequence[Output], kept: int = IMPACT_BUFFER_LENGTH) -> tuple[Output, ...]:
    """The impacts of the last communication step: how many, how many did not fit, and the fields of each.

    Args:
        fields: as of `impact_outputs`, and with the time.
        kept: as of `impact_outputs`.

    Raises:
        MechanismError: as many cannot be kept.
    """
    slots = f"impacts[1..{kept}]"
    return (
        whole_output("impacts_in_step", "impact.in_step", f"Impacts {_STEP} held in {slots}"),
        whole_output("impacts_lost", "impact.lost", f"Impacts since the start that did not fit into {slots}"),
        *_buffer("impact", IMPACT_BUFFER_LENGTH, kept, fields),
    )


def event_buffer_outputs(fields: Sequence[Output], kept: int = EVENT_BUFFER_LENGTH) -> tuple[Output, ...]:
    """The events of the last communication step: how many, and the fields of each.

    Args:
        fields: as of impacts, with "{event}" in the descriptions; runs make a table if all that an event has are there.
        kept: how many events of a step are kept, 16 to 1000.

    Raises:
        MechanismError: as many cannot be kept.
    """
    slots = f"events[1..{kept}]"
    return (
        whole_output("events_in_step", "event.in_step", f"Events {_STEP} held in {slots}"),
        *_buffer("event", EVENT_BUFFER_LENGTH, kept, fields),
    )


def _buffer(kind: str, least: int, kept: int, fields: Sequence[Output]) -> Iterator[Output]:
    if not least <= kept <= MOST_KEPT:
        raise MechanismError(f"kept = {kept}: of a step {least} to {MOST_KEPT} can be kept.")
    for k in range(1, kept + 1):
        prefix = f"{kind}s[{k}]."
        yield from (_placed(field, prefix, prefix, f"{kind} {k} {_STEP}") for field in fields)


def _placed(field: Output, prefix: str, source: str, which: str) -> Output:
    description = field.description.replace("{impact}", which).replace("{event}", which)
    return replace(field, name=f"{prefix}{field.name}", source=f"{source}{field.source}", description=description)
