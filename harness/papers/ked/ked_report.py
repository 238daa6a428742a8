"""report.html of a bending linkage."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ...fmu.values import engineering, in_display_unit
from ...report.page import cards, chart, charts, checks_list, page, points, section, table, versions_section
from ...report.plot import Curve, Plot, interactive
from ...report.style import COLOURS
from ...run.results import versions, write_text
from .files import Result
from .ked_charts import deflected, flywheel_plot, frame_plots, friction_plots, round_turn, synthesis_plots
from .solution import Solution
from .tables import (
    Shown,
    cycle_rows,
    feedback_sentence,
    flywheel_sentence,
    frame_sentence,
    frequency_rows,
    friction_sentence,
    joint_rows,
    largest_rows,
    synthesis_rows,
)

#: Modes whose frequencies are drawn.
_MODES = 3
_STATIC, _DYNAMIC, _RIGID = COLOURS[0], COLOURS[1], COLOURS[6]
_ANGLE = "crank angle [deg]"


def write_ked_report(result: Result, path: Path) -> Path:
    """Write the report as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(ked_report(result)))


def ked_report(result: Result) -> str:
    """The report as HTML."""
    found = result.solution
    body = [
        cards(_figures(found)),
        section("Verdicts", checks_list(result.checks)),
        section(
            "The linkage as it bends",
            deflected(found),
            note="Grey: rigid. In colour: bent, with its deflection exaggerated as the slider says; lengths that seem "
            "to change do so by the exaggeration. Dashed: the path of the bent linkage.",
        ),
        section("Deviation, stress, torque", charts(*(chart(interactive(plot)) for plot in _over_the_turn(found)))),
        section(
            "On the frame and in the joints",
            charts(*(chart(interactive(plot)) for plot in frame_plots(found))),
            _table(joint_rows(found), numeric=(1, 2, 3, 5)),
            note=frame_sentence(found)
            + " The force is drawn as a hodograph: the tip of its vector over a turn. The moment has the reaction of "
            "the input torque in it.",
        ),
        *_friction(result),
        *_flywheel(found),
        *_synthesis(result),
        section(
            "Natural frequencies and critical speeds",
            charts(*(chart(interactive(plot)) for plot in (_frequencies(found), _sweep(result)))),
            _table(frequency_rows(found)),
            note="Of the linkage frozen in each position. A critical speed of h = 1, 2, ... is where that multiple of "
            "the crank's speed meets the mean frequency of the mode.",
        ),
        section(
            "Largest over the turn",
            _table(largest_rows(found), numeric=(1, 2, 3, 5)),
            note=feedback_sentence(found),
        ),
        section(
            "The turn",
            _table(cycle_rows(found), long=True),
            note="x, y: rigid path. dx, dy, dev ed and the stresses: elastodynamic. dev qs: quasi-static deviation.",
        ),
    ]
    if result.notes:
        body.append(section("Notes", points(result.notes)))
    if result.parameters:
        description = result.fmu.description
        rows = [[name, *in_display_unit(value, name, description)] for name, value in result.parameters.items()]
        body.append(section("Parameters set", table(["parameter", "value", "unit"], rows, numeric=(1,))))
    body.append(versions_section(versions(result.fmu.path, result.fmu.description)))
    subtitle = f"{result.fmu.path.name}  ·  {found.place} at {found.rpm:.6g} rpm, damping ratio {found.damping:g}"
    return page(result.text, subtitle, body)


def _figures(found: Solution) -> list[tuple[str, str]]:
    torque, wheel, stresses = found.rigid.fluctuation, found.rigid.flywheel, found.dynamic.largest_stress
    (force, moment), member = found.rigid.largest_shaking, int(np.argmax(stresses))
    deviations = [
        (f"largest deviation, {kind}, at {math.degrees(bent.largest_at):.2f}°", bent.largest_deviation)
        for kind, bent in (("quasi-static", found.static), ("elastodynamic", found.dynamic))
    ]
    return [
        *((name, engineering(deviation, "m", 5)) for name, deviation in deviations),
        (f"largest stress, elastodynamic, in {found.members[member]}", engineering(float(stresses[member]), "Pa")),
        (f"shaking force, at {force.degrees:g}°", engineering(force.value, "N")),
        (f"shaking moment, at {moment.degrees:g}°", engineering(moment.value, "N.m")),
        *([(f"flywheel for a fluctuation of {wheel.coefficient:g}", f"{wheel.inertia:.4g} kg.m2")] if wheel else []),
        ("input torque", f"{torque.least:.3g} … {torque.largest:.3g} N.m"),
    ]


def _friction(result: Result) -> list[str]:
    """What friction does, where joints have any."""
    if not result.solution.rigid.rubs:
        return []
    plots = friction_plots(result.solution, result.frictionless)
    drawn = charts(*(chart(interactive(plot)) for plot in plots))
    return [section("Friction in the joints", drawn, note=friction_sentence(result.solution))]


def _flywheel(found: Solution) -> list[str]:
    """The flywheel that was asked for."""
    if found.rigid.flywheel is None:
        return []
    drawn = charts(chart(interactive(flywheel_plot(found))))
    return [section("Flywheel", drawn, note=flywheel_sentence(found))]


def _synthesis(result: Result) -> list[str]:
    """The lightest design beside that of the beginning."""
    if result.synthesis is None:
        return []
    return [
        section(
            "The lightest design within the limits",
            _table(synthesis_rows(result.synthesis, result.fmu.description), numeric=(1, 2)),
            charts(*(chart(interactive(plot)) for plot in synthesis_plots(result.synthesis))),
            note=f"Found among {result.synthesis.evaluations} designs that were judged, by sequential quadratic "
            "programming; it is the lightest nearby. All else on this page is of this design, calculated anew.",
        )
    ]


def _over_the_turn(found: Solution) -> list[Plot]:
    angle = round_turn(found.degrees, 360.0)
    path = found.rigid.path
    shown = [
        ("rigid", path, _RIGID),
        ("quasi-static", path + found.static.deflection[:, :2], _STATIC),
        ("elastodynamic", path + found.dynamic.deflection[:, :2], _DYNAMIC),
    ]
    stresses = [
        Curve(member, angle, round_turn(1e-6 * stress), COLOURS[k % len(COLOURS)])
        for k, (member, stress) in enumerate(zip(found.members, found.dynamic.stress.T, strict=True))
    ]
    return [
        Plot(
            "Deviation from the rigid path",
            _ANGLE,
            "deviation [mm]",
            [
                Curve("quasi-static", angle, round_turn(1e3 * found.static.deviation), _STATIC),
                Curve("elastodynamic", angle, round_turn(1e3 * found.dynamic.deviation), _DYNAMIC),
            ],
        ),
        Plot(
            "Path, to scale",
            "x [mm]",
            "y [mm]",
            [Curve(kind, round_turn(1e3 * at[:, 0]), round_turn(1e3 * at[:, 1]), colour) for kind, at, colour in shown],
            to_scale=True,
        ),
        Plot("Stress of the members, elastodynamic", _ANGLE, "stress [MPa]", stresses),
        Plot(
            "Torque that keeps the speed",
            _ANGLE,
            "torque [N.m]",
            [Curve("input torque", angle, round_turn(found.rigid.torque), _RIGID)],
            legend=False,
        ),
    ]


def _frequencies(found: Solution) -> Plot:
    angle = round_turn(found.degrees, 360.0)
    curves = [
        Curve(f"mode {mode + 1}", angle, round_turn(found.frequencies[:, mode]), COLOURS[mode])
        for mode in range(min(_MODES, found.modes))
    ]
    return Plot("Natural frequencies", _ANGLE, "frequency [Hz]", curves, log_y=True)


def _sweep(result: Result) -> Plot:
    sweep = result.sweep
    rpm = sweep.speed * 30 / math.pi
    return Plot(
        "Largest deviation at other speeds",
        "speed [rpm]",
        "largest deviation [mm]",
        [
            Curve("quasi-static", rpm, 1e3 * sweep.static, _STATIC),
            Curve("elastodynamic", rpm, 1e3 * sweep.dynamic, _DYNAMIC),
            *_critical(result),
        ],
        from_zero=True,
    )


def _critical(result: Result) -> list[Curve]:
    """Upright lines at the critical speeds of the lowest modes, as far as they lie within the sweep."""
    sweep, found = result.sweep, result.solution
    top = 1e3 * max(sweep.dynamic.max(), sweep.static.max())
    lines = []
    for mode in range(min(_MODES, found.modes)):
        speeds = found.critical[mode]
        within = speeds[(speeds >= sweep.speed[0]) & (speeds <= sweep.speed[-1])] * 30 / math.pi
        if within.size:
            gap = np.full(len(within), np.nan)
            x, y = np.column_stack([within, within, gap]), np.column_stack([0.0 * within, 0.0 * within + top, gap])
            lines.append(Curve(f"critical, mode {mode + 1}", x.ravel(), y.ravel(), COLOURS[2 + mode]))
    return lines


def _table(shown: Shown, numeric: tuple[int, ...] | None = None, long: bool = False) -> str:
    columns = range(len(shown.headings)) if numeric is None else numeric
    return table(shown.headings, shown.rows, numeric=tuple(columns), long=long)
