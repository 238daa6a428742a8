"""The commands that take a mechanism's description, not its FMU: `mechanism-fmu new`, `check`, `page` and `watch`."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from .options import file_option


class New(StrEnum):
    """What a new file can be like."""

    LEVER = "lever"
    FOUR_BAR = "four_bar"
    CAM = "cam"
    RATCHET = "ratchet"
    BLANK = "blank"


def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Of the file and of its FMU.", show_default=False)],
    like: Annotated[New, typer.Option("--like", help="What it begins as.")] = New.LEVER,
) -> None:
    """Write NAME.py, a mechanism of your own to begin with: a lever that falls on a stop, or what --like says.

    It builds and runs as it is, and its comments say what to change. See docs/tutorials/your-first-mechanism.md.

    Exit code: 0 all well, 2 a name that cannot be, or a file that is there already.
    """
    from .commands.one_run import new_mechanism
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(new_mechanism(name, like.value))


def check(
    file: Annotated[str, typer.Argument(metavar="FILE", help="Of a mechanism of your own.", show_default=False)],
) -> None:
    """Say everything about a file of a mechanism, in about a second, without a build.

    Parameters, inputs, outputs with units, bodies with the pose at the start, degrees of freedom, redundant joints,
    warnings, and mistakes with the line.

    Exit code: 0 no mistakes, 1 mistakes, 2 no such file.
    """
    from .commands.check_file import check_mechanism
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(check_mechanism(file))


def page(
    model: Annotated[
        str,
        typer.Argument(
            metavar="MODEL",
            help="Name of a ready-made model, e.g. 'ratchet', or file of your own mechanism.",
            show_default=False,
        ),
    ],
    output: Annotated[Path | None, file_option("FILE.html", "MODEL.html")] = None,
) -> None:
    """Write a model as a page in which its engine runs: one HTML file, for any browser, without network or server.

    Move a slider, and the run is computed anew, with the numbers of the native FMU: the mechanism in motion, curves,
    impacts; what cannot be built is refused in words. Values that you change stand in the address: send it with the
    file.

    Try:

        mechanism-fmu page ratchet

        mechanism-fmu page my_mechanism.py -o for_the_team.html

    Nothing is compiled for it. See docs/how-to/page.md.

    Exit code: 0 all well, 1 the model cannot be built, 2 wrong use.
    """
    from .commands.page_written import write_page
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(write_page(model, output))


def watch(
    file: Annotated[str, typer.Argument(metavar="FILE.py", help="File of your own mechanism.", show_default=False)],
    port: Annotated[int, typer.Option(metavar="N", help="Of the address on this machine; 0: a free one.")] = 0,
    opens: Annotated[bool, typer.Option("--open/--no-open", help="Open it in a browser.")] = True,
) -> None:
    """Show the page of a file, and build it anew whenever the file is saved.

    A mistake is said above the last page that could be built; values that you have changed on the page stay. Only this
    machine can open it. Ctrl-C ends.

    Try:

        mechanism-fmu watch my_mechanism.py

    Exit code: 0 ended by Ctrl-C, 2 wrong use.
    """
    from .commands.page_watched import watch_file
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(watch_file(file, port, opens))
