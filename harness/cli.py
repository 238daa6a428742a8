"""The command `mechanism-fmu`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from build_fmu import build

from . import machine_cli
from .cli_group import Group
from .ked.judged_by import JudgedBy

# Everything else is imported inside the commands: --help must not wait for pandas and fmpy.
main = typer.Typer(
    name="mechanism-fmu",
    cls=Group,
    help="Build planar mechanisms with impacts as FMUs, run them, and see the stress that every impact leaves.",
    epilog="Start with: mechanism-fmu demo",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
)

FmuPath = Annotated[Path, typer.Argument(metavar="FMU", help="FMU file, e.g. build/Ratchet.fmu", show_default=False)]

#: What commands with many designs share.
DesignsFolder = Annotated[
    Path | None,
    typer.Option("-o", "--output", metavar="DIR", help="Folder for the results.", show_default="the file's name"),
]
Workers = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        min=1,
        help="Processes on this machine (threads with --fast).",
        show_default="one for each processor",
    ),
]
Scheduler = Annotated[
    str | None,
    typer.Option(metavar="tcp://HOST:PORT", help="Run on the Dask cluster of this scheduler.", show_default=False),
]
Fast = Annotated[
    bool,
    typer.Option(
        "--fast",
        help="Hundreds of designs in one compiled call, in threads, without FMI calls; the numbers are the FMU's. "
        "This runs the Python sources of the FMU's model in this process.",
    ),
]
Trust = Annotated[
    bool,
    typer.Option("--trust", help="Let --fast run the Python sources of an FMU that no build of yours has made."),
]
InProcess = Annotated[
    bool,
    typer.Option(
        "--in-process",
        help="Run an FMU that no build of yours has made without a process of its own: faster by the time of a round "
        "trip a step, but what it breaks is lost with it.",
    ),
]


def _show_version(wanted: bool) -> None:
    if wanted:
        from mechanism_fmu import __version__

        typer.echo(f"mechanism-fmu {__version__}")
        raise typer.Exit


@main.callback()
def common(
    version: Annotated[
        bool, typer.Option("--version", help="Show the version and exit.", callback=_show_version, is_eager=True)
    ] = False,
) -> None:
    """Options of all commands."""


@main.command()
def demo(
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for FMU, results and report.")] = Path("demo"),
    full: Annotated[
        bool, typer.Option("--full", help="The free ratchet through four whole strokes instead of the base case.")
    ] = False,
) -> None:
    """Build the ratchet of the paper, run its base case, and write results and a report.

    The closing lines compare the first impact with reference values. With --full, the pawl is free on all teeth and the
    wheel indexes one tooth a stroke; the closing lines say whether it did. The first run compiles the engine and takes
    some seconds longer.
    """
    from .commands import run_cycle, run_demo
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_cycle(output) if full else run_demo(output))


@main.command()
def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Of the file and of its FMU.", show_default=False)],
) -> None:
    """Write NAME.py, a mechanism of your own to begin with: a lever that falls on a stop.

    It builds and runs as it is, and its comments say what to change. See docs/your-own-mechanism.md.

    Exit code: 0 all well, 2 a name that cannot be, or a file that is there already.
    """
    from .commands import new_mechanism
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(new_mechanism(name))


@main.command()
def run(
    fmu: FmuPath,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE[UNIT]",
            help="Set an input or parameter, with a unit if you like; repeat it for more.",
        ),
    ] = None,
    stop_time: Annotated[
        float | None, typer.Option(metavar="S", help="End of the run [s].", show_default="the FMU's default")
    ] = None,
    step: Annotated[
        float | None, typer.Option(metavar="S", help="Communication step [s].", show_default="the FMU's default")
    ] = None,
    input_file: Annotated[
        Path | None,
        typer.Option(
            "--input",
            metavar="FILE.csv",
            help="Input signals: a column `time [s]`, then one for each input, e.g. `drive_torque [N.mm]`; "
            "interpolated linearly, constant within a step. Also joined by semicolons, with decimal commas.",
        ),
    ] = None,
    material: Annotated[
        str,
        typer.Option(
            metavar="NAME", help="Steel of the tooth: steel, S355, C45E, 42CrMo4, SAE1015, SAE4142 or AISI4340."
        ),
    ] = "steel",
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the results.")] = Path(
        "result"
    ),
    in_process: InProcess = False,
) -> None:
    """Run an FMU and write results.csv, impacts.csv, events.csv, summary.json and report.html.

    Try:

        mechanism-fmu run build/Ratchet.fmu -o result

        mechanism-fmu run build/Ratchet.fmu --set tooth_slope_angle=95deg --set tooth_count=20

        mechanism-fmu run build/Ratchet.fmu --set "drive_torque=2 N.mm" --stop-time 3 --step 1e-4

        mechanism-fmu run build/Ratchet.fmu --input torque.csv

        mechanism-fmu run build/Ratchet.fmu --material 42CrMo4

    Ctrl-C or SIGTERM ends the run early and keeps what was recorded. An FMU that no build of yours has made runs in a
    process of its own.

    Exit code: 0 all well, 1 the run or a verdict failed, 2 wrong use, 130 interrupted.
    """
    from .commands import run_fmu
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_fmu(fmu, settings or [], stop_time, step, input_file, material, output, in_process))


@main.command()
def modes(
    fmu: FmuPath,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="NAME=VALUE[UNIT]", help="Set a parameter: some of them choose among mechanisms."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE.svg",
            help="File for the diagram.",
            show_default="<FMU>_modes.svg",
            dir_okay=False,
        ),
    ] = None,
) -> None:
    """Print the modes and transitions of an FMU's mechanism as a table, and draw them as a state chart.

    Try:

        mechanism-fmu modes build/Ratchet.fmu

        mechanism-fmu modes build/Ratchet.fmu --set guided=false -o modes.svg

    Exit code: 0 all well, 2 wrong use, or an FMU that tells none.
    """
    from .commands import show_modes
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(show_modes(fmu, settings or [], output))


@main.command()
def sweep(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="What to vary and what to keep.", show_default=False)
    ],
    output: DesignsFolder = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    fast: Fast = False,
    trust: Trust = False,
) -> None:
    """Run many designs: a grid, random ones, a Latin hypercube or Sobol points.

    A small FILE.toml:

        [fmu]
        model = "ratchet"

        [run]
        stop_time = "1.2 s"

        [sweep]
        method = "grid"

        [vary.tooth_count]
        values = [10, 15, 20, 25]

        [record]
        first_impact = ["time", "stress_max"]

    Results are kept as they come: whenever the command ends, by Ctrl-C, SIGTERM or killed by somebody, the same command
    goes on where it stopped. The table results.parquet is for pandas, report.html for people. See docs/sweeps.md.

    Exit code: 0 all well, 1 some designs failed, 2 wrong use, 130 interrupted.
    """
    from .designs_command.sweep import run_sweep
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_sweep(file, output, workers, scheduler, fast, trust))


@main.command()
def optimise(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="What is free and what is sought.", show_default=False)
    ],
    output: DesignsFolder = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    fast: Fast = False,
    trust: Trust = False,
) -> None:
    """Find the best design: variables with bounds, an objective, constraints.

    A small FILE.toml:

        [fmu]
        model = "ratchet"

        [run]
        stop_time = "1.2 s"

        [optimise]
        minimise = "first_impact.stress_max"
        count = 120

        [vary.tooth_count]
        from = 10
        to = 25

        [constraint."parameter.tooth_length"]
        at_least = 6
        unit = "mm"

    The same file finds the same design on every machine, and the same command goes on after an interruption. The files
    are those of a sweep, and optimum.json. See docs/optimum-design.md.

    Exit code: 0 all well, 1 no design keeps all constraints, 2 wrong use, 130 interrupted.
    """
    from .designs_command.optimise import run_optimise
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_optimise(file, output, workers, scheduler, fast, trust))


@main.command()
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
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE[UNIT]", help="Set a parameter; repeat it for more."),
    ] = None,
    limit_deviation: Annotated[
        str | None,
        typer.Option(
            metavar="VALUE[UNIT]", help="Of the path point from its rigid path, e.g. '1 mm'.", show_default=False
        ),
    ] = None,
    limit_stress: Annotated[
        str | None, typer.Option(metavar="VALUE[UNIT]", help="In every member, e.g. '60 MPa'.", show_default=False)
    ] = None,
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
    pin_radius: Annotated[
        str | None,
        typer.Option(
            metavar="VALUE[UNIT]", help="Of all pins, where --friction acts, e.g. '5 mm'.", show_default=False
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="DIR", help="Folder for the results.", show_default="ked_NAME"),
    ] = None,
) -> None:
    """Bend a linkage over a turn of its crank at constant speed, and write cycle.csv, summary.json and report.html.

    The links bend under the inertia of the rigid motion (quasi-statically; Erdman, Sandor and Oakberg call it
    elastodynamic analysis), and in the periodic motion that follows from it (elastodynamically; theirs is
    kineto-elastodynamic analysis): path deviation, stresses, natural frequencies, critical speeds, input torque, forces
    in the joints, shaking force and shaking moment on the frame. The FMU is built, too, and its elastic outputs are
    compared. See docs/ked.md.

    Limits alone give verdicts. With --synthesise, the depths of the members (or what --vary names) are changed until
    the linkage is as light as the limits allow, and that design is what is shown. --fluctuation sizes the flywheel that
    keeps the crank's speed even; --friction puts friction into all joints.

    Try:

        mechanism-fmu ked four_bar_path_generator

        mechanism-fmu ked four_bar_path_generator --speed "600 rpm" --set "arm_depth=16 mm" -o result

        mechanism-fmu ked four_bar_path_generator --synthesise --limit-deviation 1mm --limit-stress 60MPa

        mechanism-fmu ked four_bar_path_generator --fluctuation 0.02 --friction 0.1 --pin-radius 5mm

    Exit code: 0 all well, 1 a verdict failed, 2 wrong use.
    """
    from .ked.options import asked
    from .ked_command import run_ked
    from .terminal import user_errors

    with user_errors():
        wishes = asked(limit_deviation, limit_stress, judge, synthesise, vary or [], fluctuation, friction, pin_radius)
        raise typer.Exit(run_ked(model, speed, step, damping, settings or [], output, wishes))


@main.command()
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
    from .reproduce_command import run_reproduce
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_reproduce(rows or [], output))


@main.command()
def validate(fmu: FmuPath, in_process: InProcess = False) -> None:
    """Check an FMU: the file, its default values, a run, saving and restoring of its state, reset.

    An FMU that no build of yours has made runs in processes of its own.

    Exit code: 0 all well, 1 problems found, 2 wrong use.
    """
    from .commands import validate_fmu
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(validate_fmu(fmu, in_process))


study = typer.Typer(
    cls=Group, help="Parameter studies with one FMU.", no_args_is_help=True, rich_markup_mode="markdown"
)
main.add_typer(study, name="study")
main.add_typer(machine_cli.machine, name="machine")


@study.command("ratchet")
def study_ratchet(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the files.")] = Path(
        "study"
    ),
    fmu: Annotated[
        Path | None,
        typer.Option(metavar="FMU", help="Ratchet FMU to use.", show_default="one is built in the folder"),
    ] = None,
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
    from .commands import run_study
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_study(output, fmu))


@study.callback()
def studies() -> None:
    """Parameter studies with one FMU."""


main.command()(build)
