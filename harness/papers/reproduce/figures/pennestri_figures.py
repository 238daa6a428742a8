"""Figs 1 to 7 of Pennestrì, Valentini, Vita, as far as text and tables determine them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import chain

from mechanism_fmu.model.sawtooth import Sawtooth

from ..bench import CRANK, HINGES, PAWL, PHI, PSI, RADIUS, tooth
from ..wheel_by_hand import alpha_star, gamma_on_slope
from .drawn_pieces import (
    ACCENT,
    FILL,
    GREY,
    INK,
    SOFT,
    Point,
    View,
    box,
    box_height,
    direction,
    flow,
    label,
    middle,
    polar,
    sheet,
)


def wheel_points(count: int, angle_deg: float, turned: float) -> list[Point]:
    """Outline of a wheel, a root at the angle `turned` [rad], clockwise from there [m]."""
    shape = tooth(count, angle_deg)
    turns = [turned - k * float(shape.pitch) for k in range(count)]
    root_and_apex = (RADIUS, 0.0), apex_of(shape)
    return [polar((0.0, 0.0), radius, turn + angle) for turn in turns for radius, angle in root_and_apex]


def apex_of(shape: Sawtooth) -> tuple[float, float]:
    """Distance of a tooth's apex from the hinge [m], and its angle from the root [rad]."""
    x, y = map(float, shape.apex)
    return math.hypot(x, y), math.atan2(y, x)


def fig01_gap() -> str:
    """The tip of a body at the distance s from the boundary of another."""
    v, tip = View((60, 230), 1.0), (165.0, 60.0)
    return sheet(
        480,
        330,
        "Impact between bodies",
        v.area([(20, 20), (70, 0), (150, 15), (165, 60), (120, 90), (50, 80)]),
        v.area([(250, -20), (250, 150), (330, 170), (390, 110), (370, 10), (310, -30)], "#f0dca8"),
        v.line([(250, -40), (250, 175)], SOFT, 1.0, "7 4"),
        v.size(tip, (250.0, 60.0), "s", 0.0),
        v.dot(tip, 4, ACCENT),
        v.arrow(tip, (205, 100), ACCENT),
        v.text((215, 112), "q' of the tip"),
        v.arrow((250, 150), (205, 150), INK),
        v.text((194, 150), "n"),
        v.text((90, 45), "body i"),
        v.text((315, 70), "body j"),
        label((230, 300), "s > 0 open, s = 0 impact; s' = (∂s/∂q) q' < 0 before it, −e s' after it", 13),
    )


def fig04_nomenclature() -> str:
    """The mechanism at its start, from Table 1 and section 5."""
    v, gamma = View((215, 300), 1500), gamma_on_slope(90)
    wheel, hinge, root = (0.0, 0.0), (HINGES, 0.0), polar((0.0, 0.0), RADIUS, PSI)
    pin = polar(hinge, CRANK, PHI)
    tip = polar(pin, PAWL, gamma)
    return sheet(
        560,
        555,
        "Nomenclature",
        v.area(wheel_points(10, 90, PSI), FILL),
        v.line([wheel, root], SOFT, 1.2),
        v.line([hinge, pin], INK, 5),
        v.line([pin, tip], "#8a5a00", 5),
        v.pin(pin),
        v.hinge(wheel),
        v.hinge(hinge),
        v.dot(root, 4, ACCENT),
        v.text(root, "P₀", -16, -8),
        v.line([wheel, (0.045, 0)], SOFT, 0.8, "5 3"),
        v.arc(wheel, 0.036, 0.0, PSI, "ψ", 11),
        v.line([hinge, (HINGES + 0.05, 0)], SOFT, 0.8, "5 3"),
        v.arc(hinge, 0.036, 0.0, PHI, "φ", 11),
        v.line([pin, (pin[0] + 0.045, pin[1])], SOFT, 0.8, "5 3"),
        v.arc(pin, 0.026, 0.0, gamma, "γ", 12),
        v.size(wheel, hinge, "d = 0.130", -58),
        v.text(middle(hinge, pin), "a = 0.110", 40, 22),
        v.text(middle(pin, tip), "b = 0.100", 0, 17),
        v.text(middle(wheel, root), "r = 0.100", -38),
        v.arc(hinge, 0.062, PHI - 0.5, PHI + 0.25, ""),
        v.text(polar(hinge, 0.074, PHI - 0.35), "1 N mm", 22),
        v.text((-0.035, -0.062), "spring 15 N mm/rad"),
        label(
            (265, 530),
            f"start: φ = 77°, ψ = 75°, γ = {math.degrees(gamma):.2f}° solved at nt = 10, β₀ = 90°; lengths in m",
            13,
        ),
    )


def fig05_tooth() -> str:
    """One tooth between its roots, nt = 10, beta_0 = 90 deg, with its lengths and angles."""
    v, shape, hinge = View((270, 640), 4300), tooth(10, 90), (0.0, 0.0)
    pitch, (reach, ahead) = float(shape.pitch), apex_of(shape)
    up = math.pi / 2 + pitch / 2
    p0, apex, p1 = polar(hinge, RADIUS, up), polar(hinge, reach, up + ahead), polar(hinge, RADIUS, up - pitch)
    inner = polar(hinge, RADIUS * 0.66, up), polar(hinge, RADIUS * 0.66, up - pitch)
    slope = direction(p0, apex)
    return sheet(
        540,
        465,
        "Ratchet wheel tooth",
        v.area([inner[0], p0, apex, p1, inner[1]], FILL),
        v.line([p0, p1], SOFT, 1.1, "6 4"),
        v.size(p0, apex, "L = 1.115 h", 26),
        v.size(p0, p1, "h", -24),
        v.text(middle(apex, p1), "F", 16),
        v.arc(p0, 0.0125, up + math.pi, slope + 2 * math.pi, "β₀", 12),
        v.arc(p0, 0.026, direction(p0, p1), slope, "α₂", 13),
        v.arc(apex, 0.011, slope + math.pi, direction(apex, p1) + 2 * math.pi, "α", 12),
        v.arc((0, 0.046), 0.012, up, up - pitch, "θ", 12),
        v.dot(p0),
        v.dot(p1),
        v.dot(apex),
        v.text(p0, "P₀", -18, 2),
        v.text(p1, "P₁", 18, 4),
        v.text(apex, "T", 4, -14),
        label((270, 440), "inner radius r; nt = 10, β₀ = 90°; θ at the wheel's hinge, drawn nearer", 13),
    )


def fig06_beam() -> str:
    """The wedge as a cantilever."""
    v = View((90, 180), 1.0)
    length, height = 300.0, 130.0
    return sheet(
        480,
        310,
        "Cantilever beam model",
        v.wall((0, -18), (0, height + 18)),
        v.area([(0, 0), (0, height), (length, 0)], FILL),
        v.arrow((0, -34), (70, -34), SOFT),
        v.text((80, -34), "x"),
        v.size((0, 0), (length, 0), "l", -56),
        v.size((0, 0), (0, height), "l tan α", 34),
        v.arc((length, 0), 90, math.pi, math.pi - math.atan2(height, length), "α", 13),
        v.line([(130, 0), (130, height * (1 - 130 / length))], SOFT, 1.0, "5 3"),
        v.text((130, height * (1 - 130 / length)), "(l − x) tan α", 52, -12),
        v.arrow((length, 8), (length, 70), ACCENT),
        v.text((length, 82), "w(x, t), η'(0) = v_I"),
        label((240, 285), "thickness b = 0.02 m; A = b (l − x) tan α, I_n = b/12 (l − x)³ tan³α", 13),
    )


def fig07_shapes() -> str:
    """Both shapes with what the wedge leaves out."""
    left, right = View((30, 270), 4300), View((365, 270), 3900)
    shapes = *_shape_of(10, 90, left, "l = F"), *_shape_of(10, 105, right, "l = L cos α")
    return sheet(700, 345, "Shapes of ratchet wheel tooth", *shapes)


def _shape_of(count: int, angle: float, v: View, named: str) -> list[str]:
    """The tooth on its chord, the triangle that is the beam, and the rest in grey."""
    shape = tooth(count, angle)
    a2, beam = float(shape.chord_angle), float(shape.beam_length)
    p0, p1, apex = (0.0, 0.0), (float(shape.chord), 0.0), polar((0.0, 0.0), float(shape.slope_length), a2)
    face = direction(apex, p1)
    foot = polar(apex, beam, face)
    # across the beam at its root, towards the slope
    corner = polar(apex, beam / math.cos(float(shape.apex_angle)), a2 + math.pi)
    compared = f"{alpha_star(count, angle):.2f}° {'<' if named == 'l = F' else '≥'} 90°"
    return [
        v.area([p0, apex, p1], GREY),
        v.area([corner, apex, foot], FILL),
        v.size(apex, foot, named, 24),
        v.arc(apex, 0.008, a2 + math.pi, face + 2 * math.pi, "α", 11),
        v.arc(p0, 0.012, 0.0, a2, "α₂", 13),
        v.text(p0, "P₀", -4, 15),
        v.text(p1, "P₁", 6, 15),
        v.text(apex, "T", 0, -13),
        v.text(middle(p0, p1), f"β₀ = {angle:g}°: α* = {compared}", 0, 50, 13),
    ]


# Figs 2 and 3 of Pennestrì, Valentini, Vita: flow charts of what this project's program does.

_MIDDLE, _WIDTH, _GAP = 250.0, 300.0, 24.0

#: Fig. 2: kind and lines of the boxes from top to bottom.
_PROCEDURE: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("end", ("start: parameters, φ(0), ψ(0)",)),
    ("step", ("assemble: close Ψ = 0 by Newton's method",)),
    ("step", ("logical functions: which rows hold?",)),
    ("step", ("M, Ψ_q, γ of the rows that hold", "q'' = q''_f + M^-1/2 D⁺ (γ − Ψ_q q''_f)    (3)")),
    ("step", ("one step of Dormand–Prince 5(4)",)),
    ("choice", ("does a logical function", "change in the step?")),
    ("step", ("locate the instant, state x−",)),
    ("choice", ("does a gap close,", "s = 0 and s' < 0?")),
    ("step", ("Δq' = M^-1/2 D₁⁺ v    (7)", "record v_I, impulse, energy lost; state x+")),
)
#: Fig. 3.
_STRESS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("end", ("impact: ω(t_I−), ω(t_I+) from (7)",)),
    ("step", ("nt, β₀ → θ, h, L, α, l    Figs 5, 7",)),
    ("step", ("v_I = l (ω(t_I+) − ω(t_I−))",)),
    ("step", ("A(x), I_n(x), W_b(x)    (14)",)),
    ("step", ("Rayleigh–Ritz: Λ_i, u_i    (11), (12), (15)",)),
    ("step", ("modal m_i, k_i    (9)",)),
    ("step", ("η_i(t) from η_i(0) = 0, η_i'(0) = v_I    (10)",)),
    ("step", ("w = Σ u_i η_i    (16)",)),
    ("step", ("M_b = −E I_n w'', σ_b = M_b / W_b    (13)",)),
    ("end", ("σ_max over x and t, its place and time",)),
)


def fig02_procedure() -> str:
    """Motion with events: the loops of the stepper."""
    parts, tops, bottom = _column(_PROCEDURE)
    right, left = _MIDDLE + _WIDTH / 2, _MIDDLE - _WIDTH / 2
    y = [top + box_height(lines, kind) / 2 for top, (kind, lines) in zip(tops, _PROCEDURE, strict=True)]
    return sheet(
        560,
        int(bottom + 50),
        "What the program does: motion with impacts",
        *parts,
        # no change: end of the step
        flow([(right, y[5]), (right + 70, y[5]), (right + 70, y[3]), (right, y[3])], "no", (right + 16, y[5] - 12)),
        label((_MIDDLE + 20, tops[6] - 13), "yes", 12.5),
        flow([(left, y[7]), (left - 55, y[7]), (left - 55, y[2]), (left, y[2])], "no", (left - 14, y[7] - 12)),
        label((_MIDDLE + 20, tops[8] - 13), "yes", 12.5),
        flow([(right, y[8]), (right + 110, y[8]), (right + 110, y[2]), (right, y[2])]),
        label((_MIDDLE, bottom + 26), "until the stop time; an FMU returns at each communication point", 13),
    )


def fig03_stress() -> str:
    """From an impact to the largest stress."""
    parts, _, bottom = _column(_STRESS)
    return sheet(500, int(bottom + 20), "What the program does: stress recovery", *parts)


def _column(boxes: Sequence[tuple[str, tuple[str, ...]]]) -> tuple[list[str], list[float], float]:
    """Boxes below each other with arrows between, where each begins, and where the last ends [px]."""
    heights = [box_height(lines, kind) for kind, lines in boxes]
    tops = [16.0 + sum(heights[:k]) + k * _GAP for k in range(len(boxes))]
    first, *more = (box(_MIDDLE, top, _WIDTH, lines, kind) for top, (kind, lines) in zip(tops, boxes, strict=True))
    arrows = [flow([(_MIDDLE, top - _GAP), (_MIDDLE, top)]) for top in tops[1:]]
    return [first, *chain.from_iterable(zip(arrows, more, strict=True))], tops, tops[-1] + heights[-1]
