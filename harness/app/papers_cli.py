"""The commands that work out what the papers say: `mechanism-fmu ked`, `reproduce` and `study`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..papers.ked.judged_by import JudgedBy
from .cli_group import Group
from .options import folder_option, quantity_option, settings_option


def ked(
    model: Annotated[
        str,
        typer.Argument(
            metavar="NAME|FILE", help="Ready-made linkage, or file of your own, with members.", show_default=False
        ),
    ],
    speed: Annotated[
        str | None,
        typer.Option(
            metavar="VALUE[UNIT]", help="Of the crank, e.g. '500 rpm'.", show_default="the model's at the start"
        ),
    ] = None,
    step: Annotated[
        float, typer.Option(metavar="DEG", help="Of the crank's angle in the tables; 360 is a multiple.")
    ] = 1.0,
    damping: Annotated[float, typer.Option(metavar="RATIO", help="Of each mode of the periodic motion.")] = 0.02,
    settings: Annotated[list[str] | None, settings_option("Set a parameter; repeat it for more.")] = None,
    limit_deviation: Annotated[
        str | None, quantity_option("Of the path point from its rigid path, e.g. '1 mm'.")
    ] = None,
    limit_stress: Annotated[str | None, quantity_option("In every member, e.g. '60 MPa'.")] = None,
    judge: Annotated[
        JudgedBy,
        typer.Option(
            help="The solution that must keep to the limits; by the definitions of Erdman, Sandor and Oakberg, "
            "quasi-static is elastodynamic analysis, and elastodynamic is kineto-elastodynamic analysis."
        ),
    ] = (JudgedBy.ELASTODYNAMIC),
    synthesise: Annotated[
        bool, typer.Option("--synthesise", help="Look for the lightest members within both limits.")
    ] = False,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=LEAST..LARGEST[UNIT]",
            help="A section's size that --synthesise may change; repeat it for more.",
            show_default="depths of all members, from 1/4 to 4 times",
        ),
    ] = None,
    fluctuation: Annotated[
        float | None,
        typer.Option(
            metavar="RATIO",
            help="Size a flywheel: (largest - least speed) / mean speed, e.g. 0.02.",
            show_default=False,
        ),
    ] = None,
    friction: Annotated[
        float | None,
        typer.Option(metavar="COEFFICIENT", help="Of Coulomb friction in all joints.", show_default="the model's"),
    ] = None,
    pin_radius: Annotated[str | None, quantity_option("Of all pins, where --friction acts, e.g. '5 mm'.")] = None,
    speeds: Annotated[
        tuple[str, str, int] | None,
        typer.Option(
            metavar="FROM TO COUNT",
            help="Speeds of the crank at which the largest deviation is drawn and written to speeds.csv, e.g. "
            "'200 rpm' '800 rpm' 61.",
            show_default="31 from 0.4 to 1.4 times the speed, drawn only",
        ),
    ] = None,
    output: Annotated[Path | None, folder_option(default="ked_NAME")] = None,
) -> None:
    """Bend a linkage over a turn of its crank at constant speed, and write cycle.csv, summary.json and report.html.

    The links bend under the inertia of the rigid motion (quasi-statically; Erdman, Sandor and Oakberg call it
    elastodynamic analysis), and in the periodic motion that follows from it (elastodynamically; theirs is
    kineto-elastodynamic analysis): path deviation, stresses, natural frequencies, critical speeds, input torque, forces
    in the joints, shaking force and shaking moment on the frame. The FMU is built, too, and its elastic outputs are
    compared. See docs/how-to/ked.md.

    Limits alone give verdicts. With --synthesise, the depths of the members (or what --vary names) are changed until
    the linkage is as light as the limits allow, and that design is what is shown. --fluctuation sizes the flywheel that
    keeps the crank's speed even; --friction puts friction into all joints.

    Try:

        mechanism-fmu ked four_bar_path_generator

        mechanism-fmu ked four_bar_path_generator --speed "600 rpm" --set "arm_depth=16 mm" -o result

        mechanism-fmu ked four_bar_path_generator --synthesise --limit-deviation 1mm --limit-stress 60MPa

        mechanism-fmu ked four_bar_path_generator --fluctuation 0.02 --friction 0.1 --pin-radius 5mm

        mechanism-fmu ked four_bar_path_generator --speeds "200 rpm" "800 rpm" 61

    Exit code: 0 all well, 1 a verdict failed, 2 wrong use.
    """
    from ..papers.ked.options import asked
    from .commands.papers_run import run_ked
    from .terminal import user_errors

    with user_errors():
        wishes = asked(
            limit_deviation, limit_stress, judge, synthesise, vary or [], fluctuation, friction, pin_radius, speeds
        )
        raise typer.Exit(run_ked(model, speed, step, damping, settings or [], output, wishes))


def reproduce(
    rows: Annotated[
        list[str] | None,
        typer.Argument(metavar="[ID ...]", help="Beginnings of rows' ids, e.g. P-eq7.", show_default="all rows"),
    ] = None,
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the files.")] = Path(
        "papers-reproduced"
    ),
) -> None:
    """Work every equation, table, figure, example and claim of the three documents anew, each with a verdict.

    Writes papers-reproduced.md (docs/papers-reproduced.md is what it wrote), report.html, rows.csv and the figures.
    With ids or what they begin with, only those rows, with their worked numbers: P of Pennestrì, Valentini, Vita; E of
    Erdman, Sandor, Oakberg; S of the ME451 slides; X for misprints and assumptions that fail, C for choices.

    Try:

        mechanism-fmu reproduce

        mechanism-fmu reproduce P-eq7 E-eq13 S-3.4.1

    Exit code: 0 all well, 1 a row is not what it should be, 2 wrong use.
    """
    from .commands.papers_run import run_reproduce
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_reproduce(rows or [], output))


study = typer.Typer(
    cls=Group, help="Parameter studies with one FMU.", no_args_is_help=True, rich_markup_mode="markdown"
)


@study.command("ratchet")
def study_ratchet(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the files.")] = Path(
        "study"
    ),
    fmu: Annotated[
        Path | None,
        typer.Option(metavar="FMU", help="Ratchet FMU to use.", show_default="one is built in the folder"),
    ] = None,
    in_process: Annotated[
        bool,
        typer.Option("--in-process", help="Run an FMU that no build of yours has made without processes of its own."),
    ] = False,
) -> None:
    """The paper's case studies: 10 to 25 teeth, slope angle 85 to 105 deg, all through the same FMU.

    Prints impact time, wheel speed and largest stress of each of the 20 wheels, and checks what the paper claims of
    them. Writes Figs 8 to 11 (wheels, teeth, stress along the tooth, maximum stress) into study.html, interactive, and
    each as .svg and .png; the table into study.csv, and with parameters, verdicts and versions into study.json.

    Try:

        mechanism-fmu study ratchet -o study

        mechanism-fmu study ratchet --fmu build/Ratchet.fmu -o study

    Exit code: 0 all claims hold, 1 one does not, 2 wrong use.
    """
    from .commands.one_run import run_study
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_study(output, fmu, in_process))


@study.callback()
def studies() -> None:
    """Parameter studies with one FMU."""
