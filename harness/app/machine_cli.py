"""The commands `mechanism-fmu machine ...`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .cli_group import Group
from .options import file_option, folder_option, settings_option

machine = typer.Typer(
    cls=Group,
    no_args_is_help=True,
    rich_markup_mode="markdown",
)

MachineName = Annotated[
    str,
    typer.Argument(
        metavar="MACHINE", help="File of the machine, NAME.toml, or the name of a ready one.", show_default=False
    ),
]


@machine.callback()
def machines() -> None:
    """Several FMUs as one machine, described in a file: run it, check it, and exchange it with other tools.

    A small FILE.toml:

        [run]
        stop_time = "10 s"
        step = "5 ms"

        [component.gears]
        model = "gear_train"

        [component.gears.set]
        drive_torque = "0.1 N.m"

        [component.wheel]
        file = "Wheel.fmu"

        [[connect]]
        from = "gears.wheel_speed"
        to = "wheel.drive_speed"

    See docs/how-to/machines.md.
    """


@machine.command("run")
def run_machine(
    name: MachineName,
    input_file: Annotated[
        Path | None,
        typer.Option(
            "--input",
            metavar="FILE.csv",
            help="Signals for free inputs: a column `time [s]`, then one for each, e.g. `table.load_torque [N.m]`.",
            show_default="run.input of the file",
        ),
    ] = None,
    output: Annotated[Path | None, folder_option()] = None,
    step: Annotated[
        str | None,
        typer.Option(
            metavar="TIME", help="Communication step, e.g. `2ms`; seconds.", show_default="run.step of the file"
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        settings_option(
            "Set a parameter or a free input, e.g. `cam.drive_stiffness=3`, for this run; repeat it for more."
        ),
    ] = None,
    as_others: Annotated[
        bool,
        typer.Option(
            "--as-others",
            help="Step as the masters of other tools do: fixed steps, all components at once, inputs held, each output "
            "read once. Compare their curves of an exported machine with these.",
        ),
    ] = False,
    in_process: Annotated[
        bool,
        typer.Option(
            "--in-process",
            help="Run FMUs that no build of yours has made without processes of their own, but where the file says "
            "process = true: faster by a round trip a step, but what they break is lost with them.",
        ),
    ] = False,
) -> None:
    """Run a machine and write results.parquet, impacts.csv, summary.json and report.html.

    Without pyarrow (extra `designs`), results.csv takes the place of results.parquet, unless the file asks for one.

    Try:

        mechanism-fmu machine run indexing_table

        mechanism-fmu machine run my_machine.toml -o result

        mechanism-fmu machine run my_machine.toml --step 1ms --set "cam.drive_damping=0.1 N.m.s/rad"

    Ctrl-C or SIGTERM ends the run early and keeps what was recorded. An FMU that no build of yours has made runs in a
    process of its own.

    Exit code: 0 all well, 1 the run failed, 2 wrong use, 130 interrupted.
    """
    from ..machine.file.machine_plan import Changes
    from .commands.machine_run import run_file
    from .terminal import user_errors

    changes = Changes(step, tuple(settings or ()), as_others)
    with user_errors():
        raise typer.Exit(run_file(name, input_file, output, changes, in_process))


@machine.command("new")
def new_machine(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Of the file.", show_default=False)],
) -> None:
    """Write NAME.toml, a machine of your own to begin with: gears that turn a cam.

    It runs as it is, and its comments say what to change. See docs/how-to/machines.md.

    Exit code: 0 all well, 2 a name that cannot be, or a file that is there already.
    """
    from .commands.machine_run import new_file
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(new_file(name))


@machine.command("check")
def check_machine(name: MachineName) -> None:
    """Show what is in a machine's file: components in their order, connections, cycles; or all of its mistakes.

    Models are built for it; nothing is run.

    Exit code: 0 no mistakes, 2 mistakes or wrong use.
    """
    from .commands.machine_run import check_file
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(check_file(name))


@machine.command("export")
def export_machine(
    name: MachineName,
    output: Annotated[Path | None, file_option("FILE.ssp", "NAME.ssp")] = None,
    baked: Annotated[
        bool,
        typer.Option(
            "--baked",
            help="For tools that apply neither parameters nor gains and offsets, as fmpy and containers: put them into "
            "copies of the FMUs.",
        ),
    ] = False,
) -> None:
    """Write a machine as SSP 1.0, one file with all FMUs, for other tools.

    Try:

        mechanism-fmu machine export my_machine.toml -o my_machine.ssp

        mechanism-fmu machine export my_machine.toml -o for_everyone.ssp --baked

    Curves of other tools are those of `machine run --as-others`.

    Exit code: 0 all well, 2 wrong use.
    """
    from .commands.machine_exchange import export_file
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(export_file(name, output, baked))


@machine.command("import")
def import_machine(
    file: Annotated[Path, typer.Argument(metavar="FILE.ssp", help="System in the format SSP 1.0.", show_default=False)],
    output: Annotated[Path | None, folder_option("Folder for the machine.")] = None,
) -> None:
    """Write the system of an SSP file as a machine's file, with its FMUs beside it; nothing is overwritten.

    Try:

        mechanism-fmu machine import drive_train.ssp -o drive_train

        mechanism-fmu machine run drive_train/drive_train.toml

    Exit code: 0 all well, 2 wrong use.
    """
    from .commands.machine_exchange import import_file
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(import_file(file, output))


@machine.command("container")
def contain_machine(
    name: MachineName,
    output: Annotated[Path | None, file_option("FILE.fmu", "NAME.fmu")] = None,
) -> None:
    """Wrap a machine as one FMU, which steps its components itself: fixed steps, all at once, inputs held.

    Try:

        mechanism-fmu machine container my_machine.toml -o MyMachine.fmu

        mechanism-fmu run MyMachine.fmu

    Exit code: 0 all well, 2 wrong use, or a machine that cannot be wrapped.
    """
    from .commands.machine_exchange import contain_file
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(contain_file(name, output))
