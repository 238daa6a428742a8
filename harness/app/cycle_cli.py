"""The command that finds a periodic motion: `mechanism-fmu cycle`."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from .options import file_option, quantity_option, settings_option


class Direction(StrEnum):
    """Which way an output passes the value of a section."""

    RISING = "rising"
    FALLING = "falling"


def cycle(
    model: Annotated[
        str,
        typer.Argument(
            metavar="MODEL",
            help="Name of a ready-made model, e.g. 'pin_pallet', or file of your own mechanism.",
            show_default=False,
        ),
    ],
    section: Annotated[
        str | None,
        typer.Option(
            metavar="OUTPUT[=VALUE]",
            help="A cycle ends where this passes the value, 0 unless given.",
            show_default=False,
        ),
    ] = None,
    direction: Annotated[Direction, typer.Option(help="Which way it passes.")] = Direction.RISING,
    passages: Annotated[int, typer.Option(metavar="N", min=1, help="How many passages a cycle has.")] = 1,
    period: Annotated[str | None, quantity_option("A cycle takes so long: that of a drive.")] = None,
    unknown: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME[=OUTPUT]",
            help="What is sought of the beginning: a parameter, and the output that it is compared with at the end; or "
            "a coordinate or rate of a body, 'wheel.angle'. Once for each.",
            show_default="parameters NAME_start that have an output NAME",
        ),
    ] = None,
    advance: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE[UNIT]",
            help="What grows by itself with each cycle, and by how much: an unknown, or the section.",
            show_default=False,
        ),
    ] = None,
    settle: Annotated[
        int, typer.Option(metavar="N", min=0, help="Cycles that go by before the search: it begins where they end.")
    ] = 0,
    settings: Annotated[list[str] | None, settings_option("Value of a parameter or input. Once for each.")] = None,
    longest: Annotated[
        str | None, quantity_option("A cycle up to a section that takes longer is none; two stop times unless given.")
    ] = None,
    tolerance: Annotated[float, typer.Option(metavar="NUMBER", help="Relative, of the integration.")] = 1e-11,
    output: Annotated[Path | None, file_option("FILE.csv|FILE.json", "none", "What is found, to write.")] = None,
) -> None:
    """Find a periodic motion with impacts, and say whether it is stable: by shooting, with Floquet multipliers.

    A cycle ends after --period, or where an output passes a value, --section. What is unknown at its beginning is
    varied by Newton's method until it is the same at the end. The multipliers say by which factors a small disturbance
    grows each cycle: all within the unit circle, and it dies out. They come from differences between motions with the
    same events in the same order, extrapolated to a step of zero; where any step, however small, changes the order, as
    where a contact grazes, there is none, and it is refused by name.

    Try:

        mechanism-fmu cycle pin_pallet --section balance.angle --settle 10 --advance wheel.angle=24deg
        --unknown wheel.angle --unknown wheel.speed --unknown balance.speed

        mechanism-fmu cycle docs/examples/gallery/woodpecker.py --section bird_rate --unknown start=bird

    The page of it: docs/how-to/periodic-motions.md.

    Exit code: 0 found, stable or not, 1 there is none, or none that has multipliers, 2 wrong use.
    """
    from .commands.cycle_found import Asked, find
    from .terminal import user_errors

    asked = Asked(
        section=section,
        direction=direction.value,
        passages=passages,
        period=period,
        unknowns=tuple(unknown or ()),
        advances=tuple(advance or ()),
        settle=settle,
        settings=tuple(settings or ()),
        longest=longest,
        tolerance=tolerance,
    )
    with user_errors():
        raise typer.Exit(find(model, asked, output))
