"""What recorded findings say of parameter values."""

from dataclasses import replace

from mechanism_fmu.model.findings import messages


def said(traced, findings, values):
    """Messages of those findings of a trace that apply, from its recorded operations."""
    numbers = iter(traced.numbers([x for f in findings for x in (f.applies, *f.numbers)], values))
    return messages(
        replace(f, applies=next(numbers), numbers=tuple(next(numbers) for _ in f.numbers)) for f in findings
    )
