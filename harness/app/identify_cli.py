"""The commands that find the numbers of a model in measurements: `mechanism-fmu identify`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .cli_group import Group
from .options import file_option

identify = typer.Typer(
    cls=Group, help="Find numbers of a model in measurements.", no_args_is_help=True, rich_markup_mode="markdown"
)


@identify.callback()
def measurements() -> None:
    """Find numbers of a model in measurements."""


@identify.command()
def impacts(
    file: Annotated[Path, typer.Argument(metavar="FILE.csv", help="Measured impacts, one a row.", show_default=False)],
    folds: Annotated[
        int, typer.Option(metavar="N", help="Parts of the rows, each predicted by a fit to the others.")
    ] = 5,
    seed: Annotated[int, typer.Option(metavar="N", help="Decides parts and intervals.", min=0)] = 1,
    unflagged: Annotated[
        bool, typer.Option("--unflagged", help="Leave out rows with a 1 in the column `flags`.")
    ] = False,
    output: Annotated[Path | None, file_option("FILE.csv", "none", "Table of the laws to write.")] = None,
) -> None:
    """Fit restitution and friction of each law of impacts to measured ones, and say which law to use.

    A row is an impact of a body at one point, in the plane, SI units and radians, counter-clockwise positive. Columns,
    in any order: vx_before, vy_before, omega_before, vx_after, vy_after, omega_after: velocity of the centre of mass
    and of the angle; r_x, r_y: contact point minus centre of mass; n_x, n_y: unit normal into the body;
    radius_of_gyration. Others are left alone; lines that begin with # are comments.

    The laws: Newton, Poisson, Stronge (the engine has these), Wang-Mason, and Newton with a restitution along the
    tangent. Of each the numbers of least mean error, with 95 % intervals by bootstrap over the rows; errors as shares
    of the velocity after the impact, in the norm of the kinetic energy; the same on rows that the fit has not seen
    (cross-validation). Two bounds: the error with numbers of each impact's own, and that of the best impulse at the
    contact, below which no rigid law can be. The last line puts law and numbers into a model. See
    docs/how-to/identify-impacts.md.

    Try:

        mechanism-fmu identify impacts impacts.csv

        mechanism-fmu identify impacts impacts.csv --folds 10 --unflagged -o laws.csv

    Exit code: 0 all well, 2 wrong use, or a table that cannot be used.
    """
    from .commands.impacts_identified import identify_impacts
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(identify_impacts(file, folds, seed, unflagged, output))
