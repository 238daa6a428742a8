"""study.html: the paper's study with its two charts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from mechanism_fmu.stress import WedgeTooth

from ..numbers import engineering
from ..results import write_text
from ..study import Study
from ..tooth_stress import stress_field
from ..wheels import Wheel
from .page import cards, chart, checks_list, page, section, table
from .style import COLOURS, WIDE_TOP, layout


def write_study_report(study: Study, path: Path) -> Path:
    """Write the report of the study as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(study_report(study)))


def study_report(study: Study) -> str:
    """The report as HTML."""
    largest = max(study.wheels, key=lambda wheel: wheel.stress_max)
    smallest = min(study.wheels, key=lambda wheel: wheel.stress_max)
    figures = [
        ("wheels", str(len(study.wheels))),
        (f"largest stress: {largest}", engineering(largest.stress_max, "Pa")),
        (f"smallest stress: {smallest}", engineering(smallest.stress_max, "Pa")),
    ]
    body = [
        cards(figures),
        section("What the paper claims", checks_list(study.checks)),
        section(
            "Stress along the tooth",
            chart(along_chart(study.wheels)),
            note="At the instant of the largest stress, over the normalised length, as in Fig. 10 of the paper; "
            "dots mark the maximum.",
        ),
        section(
            "Maximum bending stress",
            chart(maximum_chart(study.wheels)),
            note="Over slope angle and number of teeth, as in Fig. 11 of the paper.",
        ),
        section("All wheels", _wheels_table(study.wheels)),
    ]
    if study.warnings:
        body.append(section("Warnings of the FMU", table(["message"], [[text] for text in study.warnings])))
    return page("The paper's ratchet study", f"{study.fmu.name}  ·  first impact of each wheel", body)


def along_chart(wheels: Sequence[Wheel]) -> go.Figure:
    """Stress along the normalised length: a chart for each number of teeth, a curve for each slope angle."""
    counts = sorted({wheel.tooth_count for wheel in wheels})
    rows = math.ceil(len(counts) / 2)
    figure = make_subplots(
        rows=rows,
        cols=2,
        vertical_spacing=0.12,
        horizontal_spacing=0.08,
        subplot_titles=[f"{count} teeth" for count in counts],
    )
    for i, count in enumerate(counts):
        place = {"row": i // 2 + 1, "col": i % 2 + 1}
        for k, wheel in enumerate(w for w in wheels if w.tooth_count == count):
            field = stress_field(WedgeTooth(wheel.tooth_length, wheel.tooth_apex_angle), wheel.impact_velocity)
            name = f"β₀ = {wheel.slope_angle_deg}°"
            common = {"name": name, "legendgroup": name, "marker": {"color": COLOURS[k % len(COLOURS)], "size": 7}}
            curve = go.Scatter(x=field.position, y=field.along, mode="lines", showlegend=i == 0, **common)
            peak = go.Scatter(
                x=[wheel.stress_position], y=[wheel.stress_max], mode="markers", showlegend=False, **common
            )
            figure.add_trace(curve, **place)
            figure.add_trace(peak, **place)
    figure.update_xaxes(title_text="x / length, from the root [1]", row=rows)
    figure.update_yaxes(exponentformat="SI", rangemode="tozero")
    figure.update_yaxes(title_text="stress [Pa]", col=1)
    figure.update_layout(layout(height=740, margin=WIDE_TOP, legend={"orientation": "h", "y": -0.1}))
    return figure


def maximum_chart(wheels: Sequence[Wheel]) -> go.Figure:
    """Maximum stress over the slope angle, a curve for each number of teeth."""
    figure = go.Figure()
    for k, count in enumerate(sorted({wheel.tooth_count for wheel in wheels})):
        curve = [wheel for wheel in wheels if wheel.tooth_count == count]
        figure.add_trace(
            go.Scatter(
                x=[wheel.slope_angle_deg for wheel in curve],
                y=[wheel.stress_max for wheel in curve],
                name=f"{count} teeth",
                mode="lines+markers",
                line={"color": COLOURS[k % len(COLOURS)], "width": 2},
                marker={"size": 8},
            )
        )
    figure.update_xaxes(title_text="slope angle β₀ [deg]", dtick=5)
    figure.update_yaxes(title_text="maximum stress [Pa]", exponentformat="SI", rangemode="tozero")
    figure.update_layout(layout(height=440, legend={"orientation": "h", "y": -0.2}))
    return figure


def _wheels_table(wheels: Sequence[Wheel]) -> str:
    headings = (
        "teeth",
        "β₀ [deg]",
        "t_I [s]",
        "ω(t_I+) [rad/s]",
        "v_I [m/s]",
        "σ_max [Pa]",
        "at x/l [1]",
        "l [mm]",
        "α [deg]",
    )
    rows = [
        [
            str(wheel.tooth_count),
            str(wheel.slope_angle_deg),
            f"{wheel.impact_time:.10f}",
            f"{wheel.wheel_speed:.10f}",
            f"{wheel.impact_velocity:.6e}",
            f"{wheel.stress_max:.1f}",
            f"{wheel.stress_position:.4f}",
            f"{wheel.tooth_length * 1e3:.3f}",
            f"{math.degrees(wheel.tooth_apex_angle):.3f}",
        ]
        for wheel in wheels
    ]
    return table(headings, rows, numeric=range(len(headings)))
