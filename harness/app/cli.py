"""The command `mechanism-fmu`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from build_fmu import build

from . import cycle_cli, designs_cli, file_cli, identify_cli, machine_cli, papers_cli
from .cli_group import Group
from .options import file_option, settings_option

# Everything else is imported inside the commands: --help must not wait for pandas and fmpy.
main = typer.Typer(
    name="mechanism-fmu",
    cls=Group,
    help="Build planar mechanisms with impacts as FMUs, run them, and see the stress that every impact leaves.",
    epilog="Start with: mechanism-fmu demo",
    no_args_is_help=True,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
)


FmuPath = Annotated[Path, typer.Argument(metavar="FMU", help="FMU file, e.g. build/Ratchet.fmu", show_default=False)]

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
    quiet: Annotated[
        bool, typer.Option("--quiet", help="Of all commands: print warnings and errors only, on stderr.")
    ] = False,
    as_json: Annotated[
        bool,
        typer.Option(
            "--json", help="Of all commands: print one JSON object, with the exit code and all that is shown."
        ),
    ] = False,
) -> None:
    """Options of all commands; these may also stand behind the command."""


@main.command()
def demo(
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for FMU, results and report.")] = Path("demo"),
    full: Annotated[
        bool, typer.Option("--full", help="The free ratchet through four whole strokes instead of the base case.")
    ] = False,
) -> None:
    """Build the ratchet of the paper, run its base case, and write results and a report.

    The closing lines compare the first impact with reference values. With --full, the pawl is free on all teeth and the
    wheel indexes one tooth a stroke; the closing lines say whether it did.
    """
    from .commands.one_run import run_cycle, run_demo
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_cycle(output) if full else run_demo(output))


main.command()(file_cli.new)
main.command()(file_cli.check)


@main.command()
def doctor() -> None:
    """Say what is installed here, what is missing, and how to get it.

    Python and packages, the linker of native FMUs, the cache folder, whether the engine is compiled.

    Exit code: 0 all that everything needs is there, 1 something is missing.
    """
    from .commands.doctor import examine
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(examine())


@main.command()
def examples(
    folder: Annotated[
        Path | None,
        typer.Argument(
            metavar="FOLDER", help="Where to copy them, with --copy.", show_default="examples", file_okay=False
        ),
    ] = None,
    copy: Annotated[bool, typer.Option("--copy", help="Copy them into FOLDER; no file there is overwritten.")] = False,
) -> None:
    """List the examples: sweeps, searches of an optimum, machines, programs; with --copy, copy them.

    Exit code: 0 all well, 2 a file of an example's name is there already.
    """
    from .commands.examples import show_examples
    from .terminal import user_errors

    if folder is not None and not copy:
        raise typer.BadParameter(f"to copy the examples to {folder}, add --copy.", param_hint="FOLDER")
    with user_errors():
        raise typer.Exit(show_examples((folder or Path("examples")) if copy else None))


@main.command()
def run(
    fmu: FmuPath,
    settings: Annotated[
        list[str] | None, settings_option("Set an input or parameter, with a unit if you like; repeat it for more.")
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.toml",
            help="Inputs and parameters to set, one a line, `drive_torque = 0.002` or `drive_torque = '2 N.mm'`, as a "
            "page saves them; what --set says holds.",
        ),
    ] = None,
    stop_time: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="End of the run, e.g. `500ms`; seconds.", show_default="the FMU's default"),
    ] = None,
    step: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Communication step, e.g. `2ms`; seconds.", show_default="the FMU's default"),
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
        str | None,
        typer.Option(
            metavar="NAME",
            help="Steel of what is struck: steel, S355, C45E, 42CrMo4, SAE1015, SAE4142 or AISI4340.",
            show_default="steel",
        ),
    ] = None,
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the results.")] = Path(
        "result"
    ),
    in_process: InProcess = False,
    units_row: Annotated[
        bool, typer.Option("--units-row", help="Write the units as a second row of each table, below the names.")
    ] = False,
    integrator: Annotated[
        str | None,
        typer.Option(
            metavar="METHOD",
            help="Integrate it here, by its interface for Model Exchange: DOP853 or RK45 (needs scipy).",
            show_default="co-simulation, if it has that",
        ),
    ] = None,
    tolerance: Annotated[
        float | None, typer.Option(metavar="NUMBER", help="Relative tolerance of --integrator.", show_default="1e-9")
    ] = None,
) -> None:
    """Run an FMU and write results.csv, impacts.csv, events.csv, summary.json and report.html.

    impacts.csv has a row for each impact: time, contact, closing speed, impulse and what else the FMU reports of it.

    events.csv has a row for each event: time, guard (what happened), closed contacts before and after, total impulse.

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
    from .commands.one_run import run_fmu
    from .terminal import user_errors

    with user_errors():
        code = run_fmu(
            *(fmu, settings or [], stop_time, step, input_file, material, output, in_process, units_row, parameters),
            integrator=integrator,
            tolerance=tolerance,
        )
        raise typer.Exit(code)


@main.command()
def modes(
    fmu: FmuPath,
    settings: Annotated[
        list[str] | None, settings_option("Set a parameter: some of them choose among mechanisms.")
    ] = None,
    output: Annotated[Path | None, file_option("FILE.svg", "<FMU>_modes.svg", "File for the diagram.")] = None,
) -> None:
    """Print the modes and transitions of an FMU's mechanism as a table, and draw them as a state chart.

    Try:

        mechanism-fmu modes build/Ratchet.fmu

        mechanism-fmu modes build/Ratchet.fmu --set guided=false -o modes.svg

    Exit code: 0 all well, 2 wrong use, or an FMU that has none.
    """
    from .commands.one_run import show_modes
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(show_modes(fmu, settings or [], output))


main.command()(file_cli.page)
main.command()(file_cli.watch)
main.command()(designs_cli.sweep)
main.command()(designs_cli.optimise)
main.command()(designs_cli.gradient)
main.command()(cycle_cli.cycle)
main.command()(papers_cli.ked)
main.command()(papers_cli.reproduce)


@main.command()
def validate(fmu: FmuPath, in_process: InProcess = False) -> None:
    """Check an FMU: the file, its default values, a run, saving and restoring of its state, reset.

    An FMU that no build of yours has made runs in processes of its own.

    Exit code: 0 all well, 1 problems found, 2 wrong use.
    """
    from .commands.one_run import validate_fmu
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(validate_fmu(fmu, in_process))


main.add_typer(identify_cli.identify, name="identify")
main.add_typer(papers_cli.study, name="study")
main.add_typer(machine_cli.machine, name="machine")

main.command()(build)
