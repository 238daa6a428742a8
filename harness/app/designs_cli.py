"""The commands `mechanism-fmu sweep`, `optimise` and `gradient`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import file_option, folder_option, quantity_option, settings_option

#: What commands with many designs share.
DesignsFolder = Annotated[
    Path | None,
    folder_option(),
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
    goes on where it stopped. The table results.parquet is for pandas, report.html for people. See
    docs/how-to/sweeps.md.

    Exit code: 0 all well, 1 some designs failed, 2 wrong use, 130 interrupted.
    """
    from .commands.designs_run import run_sweep
    from .commands.designs_shared import Runners
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_sweep(file, output, Runners(workers, scheduler, fast, trust)))


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
    are those of a sweep, and optimum.json. See docs/how-to/optimum-design.md.

    Exit code: 0 all well, 1 no design keeps all constraints, 2 wrong use, 130 interrupted.
    """
    from .commands.designs_run import run_optimise
    from .commands.designs_shared import Runners
    from .terminal import user_errors

    with user_errors():
        raise typer.Exit(run_optimise(file, output, Runners(workers, scheduler, fast, trust)))


def gradient(
    model: Annotated[
        str,
        typer.Argument(
            metavar="MODEL|FMU",
            help="Name of a ready-made model, e.g. 'ratchet', file of your own mechanism, or FMU.",
            show_default=False,
        ),
    ],
    of: Annotated[
        list[str],
        typer.Option(
            "--of", metavar="QUANTITY", help="When and what, as 'first_impact.time'. Once for each.", show_default=False
        ),
    ],
    by: Annotated[
        list[str] | None,
        typer.Option(
            "--by",
            metavar="NAME",
            help="Parameter or input. Once for each.",
            show_default="all Real ones but those of the integration",
        ),
    ] = None,
    settings: Annotated[list[str] | None, settings_option("Value of a parameter or input. Once for each.")] = None,
    stop_time: Annotated[str | None, quantity_option("End of the run; the model's unless given.")] = None,
    step: Annotated[str | None, quantity_option("Communication step; the model's unless given.")] = None,
    trust: Annotated[
        bool,
        typer.Option(
            "--trust",
            help="Run the Python sources of an FMU that no build of yours has made in this process, which is faster.",
        ),
    ] = False,
    output: Annotated[Path | None, file_option("FILE.csv|FILE.json", "none", "What is found, to write.")] = None,
) -> None:
    """Say how quantities of a run change with parameters and inputs: derivatives, through impacts.

    They come from differences between designs that have the same events, extrapolated to a step of zero, with an
    estimate of their error. Where any step, however small, changes the events, as where a contact grazes, there is no
    derivative, and it is said why. Quantities are those of sweeps: end, max or min of an output, first_impact,
    largest_impact or all_impacts with a stress, parameter.

    Try:

        mechanism-fmu gradient ratchet --of first_impact.time --of first_impact.stress_max --stop-time 1.2s

    The page of it: docs/how-to/gradients.md.

    Exit code: 0 all well, 1 a derivative that was asked for --by name does not exist, 2 wrong use.
    """
    from .commands.gradient_found import Asked, find
    from .terminal import user_errors

    asked = Asked(model, tuple(of), tuple(by or ()), tuple(settings or ()), stop_time, step, trust)
    with user_errors():
        raise typer.Exit(find(asked, output))
