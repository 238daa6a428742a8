"""Commands `ked` and `reproduce`: elastodynamics of a linkage, and the papers' rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

from rich.markup import escape

import build_fmu
from mechanism_fmu.elastodynamics import LinkageError, crank_of, with_friction

from ...errors import UsageError
from ...fmu import Fmu, open_fmu
from ...fmu.description import Description, Value
from ...papers.ked import tables
from ...papers.ked.files import Result, agreement, write_result
from ...papers.ked.ked_report import write_ked_report
from ...papers.ked.options import Asked, quantity
from ...papers.ked.solution import Solution
from ...papers.ked.solve import Turn, prepared, solved, swept
from ...papers.ked.synthesis import bounds_of, synthesised
from ...papers.reproduce.bench import Bench
from ...papers.reproduce.figures.all_figures import write_figures
from ...papers.reproduce.papers_page import (
    FIGURE_FOLDER,
    frame,
    judgements,
    markdown,
    summary_rows,
    write_reproduce_report,
)
from ...papers.reproduce.perform import Reproduction, chosen, perform
from ...papers.reproduce.row import Document, Row
from ...run.checks import all_passed
from ...run.experiment import start_values
from ...run.results import prepare_folder, write_text
from ..execution import alone_in
from ..terminal import FAILED, console, show_checks, show_files, show_progress, show_table

# What the command `reproduce` does.


def run_reproduce(asked: Sequence[str], folder: Path) -> int:
    """Work the rows, show and write what comes of it, and return the exit code."""
    chosen(asked)
    with alone_in(folder, waits=False), ExitStack() as stack:
        opened: list[Fmu] = []

        def fmu() -> Fmu:
            """The paper's ratchet, built when a row first needs it."""
            if not opened:
                opened.append(stack.enter_context(open_fmu(build_fmu.built("ratchet", folder))))
            return opened[0]

        with show_progress("Working the rows; the engine is compiled first ...") as progress:

            def on_row(row: Row, number: int, of: int) -> None:
                progress(f"{row.id}, {row.place}", (number - 1) / of)

            made = perform(asked, Bench(fmu), on_row)
        files = _written(made, folder)
    _show(made)
    show_files(files)
    return FAILED if made.failed else 0


def _written(made: Reproduction, folder: Path) -> list[Path]:
    files = []
    if made.figures:
        prepare_folder(folder / FIGURE_FOLDER)
        write_figures(made.figures, folder / FIGURE_FOLDER)
    files.append(write_text(folder / "papers-reproduced.md", lambda file: file.write(markdown(made))))
    files.append(write_text(folder / "rows.csv", lambda file: frame(made).to_csv(file, index=False)))
    return [*files, write_reproduce_report(made, folder / "report.html")]


def _show(made: Reproduction) -> None:
    """Verdicts in the terminal; of some rows, also their numbers."""
    if made.whole:
        headings = ["verdict", *(document.short for document in Document)]
        rows = [line[:-1] for line in summary_rows(made)]
        show_table("Rows by verdict", headings, rows, numeric=(1, 2, 3))
        lists = f"{len(made.misprints)} misprints and {len(made.assumptions)} assumptions that fail, with proof"
        console.print(f"{judgements(made)} {lists}, {len(made.choices)} choices.", soft_wrap=True)
        shown = made.failed
    else:
        shown = made.everything
    for result in shown:
        row, found = result.row, result.found
        console.print(f"[bold]{row.id}[/] {escape(row.place)}: {escape(row.says)}", soft_wrap=True)
        console.print(f"    printed  {escape(row.printed)}", soft_wrap=True)
        console.print(f"    here     {escape(found.ours)}", soft_wrap=True)
        for line in found.worked:
            console.print(f"             {escape(line)}", soft_wrap=True)
        console.print(
            f"    [bold]{escape(str(found.verdict))}[/]  [dim]{escape(', '.join(row.code))}[/]", soft_wrap=True
        )


# What the command `ked` does.

#: Rows of the turn that fit a terminal, and its width below which columns are left out.
_MOST_ROWS, _NARROW = 36, 120
#: The finest step [deg]: what is finer takes long, and no curve shows it.
_FINEST = 0.1


def run_ked(
    model: str,
    speed: str | None,
    step: float,
    damping: float,
    settings: Sequence[str],
    folder: Path | None,
    asked: Asked | None = None,
) -> int:
    """Bend a linkage over a turn, show and write what comes of it, and return the exit code.

    Args:
        model: name of a ready-made one, or file.
        speed: of the crank, with its unit; None: that of the model at the start.
        step: of the crank's angle in the tables [deg].
        damping: ratio of every mode.
        settings: parameters, "name=value unit".
        folder: for the results.
        asked: limits, synthesis, flywheel, friction and speeds.

    Raises:
        UsageError: something of it cannot be; the message says what and what to do.
    """
    samples, asked = _samples(step), asked or Asked()
    if not 0.0 <= damping < 1.0:
        raise UsageError(f"The damping ratio is {damping:g}; give one from 0 to below 1, e.g. 0.02 for 2 %.")
    if model in build_fmu.model_names():
        _refuse_rigid(build_fmu.mechanism(model), model)
    folder = Path(f"ked_{Path(model).stem}") if folder is None else folder
    with alone_in(folder, waits=False):
        console.print(f"Building the FMU of {escape(model)} into {escape(str(folder))} ...", soft_wrap=True)
        with open_fmu(build_fmu.built(model, folder)) as fmu:
            parameters = _parameters(settings, fmu.description)
            mechanism = _described(model, parameters)
            _refuse_rigid(mechanism, model)
            turning = _speed(speed, mechanism, fmu.description)
            with show_progress("Position, deflection and vibration over the turn ...") as progress:
                result = _result(model, fmu, parameters, turning, damping, samples, asked, progress)
            files = [*write_result(result, folder), write_ked_report(result, folder / "report.html")]
    _show_turn(result)
    show_files(files)
    return 0 if all_passed(result.checks) else FAILED


def _result(
    model: str,
    fmu: Fmu,
    parameters: dict[str, Value],
    speed: float,
    damping: float,
    samples: int,
    asked: Asked,
    progress: Callable[[str, float], None],
) -> Result:
    """The turn, of the lightest design where that is asked for."""

    def described(values: Mapping[str, Value]) -> Any:
        return _rubbing(_described(model, values), asked)

    def analysed(mechanism: Any) -> tuple[Turn, Solution]:
        turned = prepared(mechanism, speed, damping, samples)
        return turned, solved(turned, speed, damping, samples, asked.fluctuation)

    synthesis = None
    searching = 0.6 if asked.synthesise else 0.0
    if asked.synthesise:
        description = fmu.description
        synthesis = synthesised(
            bounds_of(asked.vary, described, parameters, description),
            described,
            parameters,
            description,
            prepared(described(parameters), speed, damping, samples).place,
            speed,
            damping,
            asked.limits,
            lambda values: analysed(described({**parameters, **values}))[1],
            lambda text, done: progress(text, searching * done),
        )
        parameters = {**parameters, **synthesis.values}
    turned, found = analysed(described(parameters))
    plain = None if asked.friction is None else analysed(_described(model, parameters))[1]
    progress("The same positions in the FMU ...", searching + 0.1 * (1.0 - searching))
    mechanism = _described(model, parameters)
    compared = found if plain is None else plain
    agreed = replace(agreement(fmu, mechanism, compared, parameters), frictionless=plain is not None)
    begun = searching + 0.2 * (1.0 - searching)
    sweep = swept(turned, speed, lambda text, done: progress(text, begun + (1.0 - begun) * done), asked.speeds)
    text, drawn_only = fmu.description.text, asked.speeds is None
    return Result(fmu, text, parameters, found, sweep, agreed, asked.limits, synthesis, plain, not drawn_only)


def _described(model: str, parameters: Mapping[str, Value]) -> Any:
    return build_fmu.mechanism(model, **{name: float(value) for name, value in parameters.items()})


def _rubbing(mechanism: Any, asked: Asked) -> Any:
    """With the friction that is asked for.

    Raises:
        UsageError: it has pins, and their radius is not given.
    """
    if asked.friction is None:
        return mechanism
    try:
        return with_friction(mechanism, asked.friction, asked.pin_radius)
    except LinkageError as error:
        way_out = " Add --pin-radius '5 mm', for instance." if asked.pin_radius is None else ""
        raise UsageError(f"{error}{way_out}") from error


def _refuse_rigid(mechanism: Any, model: str) -> None:
    """Refuse a mechanism without members.

    Raises:
        UsageError: it has none; the message names the models that have.
    """
    if mechanism.members:
        return
    ready = ", ".join(build_fmu.models_that_bend())
    raise UsageError(
        f"The links of {model} are rigid: its mechanism has no members, so nothing bends. Linkages with members: "
        f"{ready}. In a file of your own, give Mechanism(..., members=...); see docs/how-to/ked.md."
    )


def _samples(step: float) -> int:
    """Angles of a turn.

    Raises:
        UsageError: the step is too fine, or 360 deg are no multiple of it.
    """
    samples = round(360 / step) if step > 0.0 else 0
    if step < _FINEST or samples < 8 or abs(samples * step - 360) > 1e-9 * 360:
        raise UsageError(
            f"--step {step:g} deg cannot be: give one from {_FINEST:g} to 45 of which 360 is a multiple, e.g. 1 or 5."
        )
    return samples


def _parameters(settings: Sequence[str], description: Description) -> dict[str, Value]:
    values = start_values(settings, description)
    for name in values:
        if description.variable(name).causality != "parameter":
            raise UsageError(f"'{name}' is an input: the turn has its own speed and torque. Set parameters only.")
    return values


def _speed(text: str | None, mechanism: Any, description: Description) -> float:
    """Speed of the crank [rad/s]: what is asked for, or that of the mechanism at the start.

    Raises:
        UsageError: it is no speed, or not positive.
    """
    if text is not None:
        speed = quantity("speed", text, "rad/s", description, "rpm")
    else:
        try:
            crank = crank_of(mechanism)
        except LinkageError as error:
            raise UsageError(str(error)) from error
        speed = next(float(body.start_rate[2]) for body in mechanism.bodies if body.name == crank)
    if not (0.0 < speed < math.inf):
        raise UsageError(f"The crank's speed is {speed:g} rad/s; give a positive one with --speed, e.g. '500 rpm'.")
    return speed


def _show_turn(result: Result) -> None:
    """The turn in the terminal."""
    found = result.solution
    console.print(
        f"[bold]{escape(result.text)}[/]: {escape(found.place)} at {found.rpm:.6g} rpm, "
        f"damping ratio {found.damping:g}",
        soft_wrap=True,
    )
    shown = tables.cycle_rows(found)
    shown = shown.every(math.ceil(len(shown.rows) / _MOST_ROWS))
    if console.width < _NARROW:
        shown = shown.without(tables.narrow_columns(found))
    title = "A turn: dx, dy, dev ed and stresses elastodynamic, dev qs quasi-static; shake: on the frame"
    show_table(title, shown.headings, shown.rows, numeric=range(len(shown.headings)))
    frequencies, largest = tables.frequency_rows(found), tables.largest_rows(found)
    title = "Natural frequencies over the turn, and critical speeds: harmonic h of the crank meets the mean"
    show_table(title, frequencies.headings, frequencies.rows, numeric=range(len(frequencies.headings)))
    show_table("Largest over the turn", largest.headings, largest.rows, numeric=(1, 2, 3, 5))
    joints = tables.joint_rows(found)
    show_table("Forces in the joints", joints.headings, joints.rows, numeric=(1, 2, 3, 5))
    if result.synthesis is not None:
        lightest = tables.synthesis_rows(result.synthesis, result.fmu.description)
        title = f"The lightest design within the limits, of {result.synthesis.evaluations} that were judged"
        show_table(title, lightest.headings, lightest.rows, numeric=(1, 2))
        again = " ".join(f'--set "{row[0]}={row[2]} {row[3]}"' for row in lightest.rows[: len(result.synthesis.bounds)])
        console.print(f"This design again: {escape(again)}", soft_wrap=True)
    torque = found.rigid.fluctuation
    console.print(
        f"Input torque: {torque.least:.4g} to {torque.largest:.4g} N.m; between its extremes, the "
        f"energy that it has given beyond its mean varies by {torque.energy:.4g} J.",
        soft_wrap=True,
    )
    for sentence in (
        tables.frame_sentence(found),
        tables.friction_sentence(found),
        tables.flywheel_sentence(found),
        tables.feedback_sentence(found),
    ):
        if sentence:
            console.print(sentence, soft_wrap=True)
    show_checks(result.checks)
    for note in result.notes:
        console.print(f"[yellow]Note:[/] {escape(note)}", soft_wrap=True)
