"""Components of a machine as running instances."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from ..fmu.slave import MessageHandler
from ..isolation import LONG_TIME_LIMIT
from ..machine.component import Component
from ..machine.file.plan import Scheme
from ..machine.impact_times import reports_impacts
from ..machine.prepared import Prepared
from ..machine.remote import TIME_LIMIT, in_own_process


@contextmanager
def instantiated(machine: Prepared, on_message: MessageHandler) -> Iterator[dict[str, Component]]:
    """An instance of each component's FMU, in a process of its own where the plan says so; all are freed afterwards.

    Where steps end at events, FMUs of FMI 3.0 that can end a step at one of their own may do so.

    Raises:
        FmuError: an FMU refuses.
    """
    with ExitStack() as stack:
        parts: dict[str, Component] = {}
        by_event = machine.plan.policy.scheme is Scheme.EVENT_AWARE
        for component in machine.plan.components:
            name, fmu = component.name, machine.fmus[component.name]
            # One that lists its impacts is taken to the first of them, which needs the list of the whole step.
            early = by_event and fmu.description.returns_early and not reports_impacts(fmu.description)
            if component.apart:
                usual = TIME_LIMIT if component.process else LONG_TIME_LIMIT
                limit = usual if component.time_limit is None else component.time_limit
                parts[name] = stack.enter_context(in_own_process(fmu, name, on_message, limit, early))
            else:
                parts[name] = stack.enter_context(fmu.instantiate(name, on_message, early))
        yield parts
