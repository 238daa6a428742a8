"""Figs 1 to 7 of Pennestrì, Valentini, Vita, as far as text and tables determine them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..bench import CRANK, HINGES, PAWL, PHI, PSI, RADIUS, alpha_star, gamma_on_slope, tooth
from .drawn_pieces import ACCENT, FILL, GREY, INK, SOFT, Point, View, box, box_height, flow, label, polar, sheet

# Figs 1 and 4 to 7 of Pennestrì, Valentini, Vita, as far as text and tables determine them.

_DEG = math.pi / 180


def wheel_points(count: int, angle_deg: float, turned: float) -> list[Point]:
    """Outline of a wheel, a root at the angle `turned` [rad], clockwise from there [m]."""
    shape = tooth(count, angle_deg)
    radius = math.hypot(*map(float, shape.apex))
    offset = math.atan2(float(shape.apex[1]), float(shape.apex[0]))
    points: list[Point] = []
    for k in range(count):
        at = turned - k * float(shape.pitch)
        points += [polar((0.0, 0.0), RADIUS, at), polar((0.0, 0.0), radius, at + offset)]
    return points


def fig01_gap() -> str:
    """The tip of a body at the distance s from the boundary of another."""
    v = View((60, 230), 1.0)
    first = [(20, 20), (70, 0), (150, 15), (165, 60), (120, 90), (50, 80)]
    tip = (165.0, 60.0)
    foot = (250.0, 60.0)
    second = [(250, -20), (250, 150), (330, 170), (390, 110), (370, 10), (310, -30)]
    parts = [
        v.area(first),
        v.area(second, "#f0dca8"),
        v.line([(250, -40), (250, 175)], SOFT, 1.0, "7 4"),
        v.size(tip, foot, "s", 0.0),
        v.dot(tip, 4, ACCENT),
        v.arrow((165, 60), (205, 100), ACCENT),
        v.text((215, 112), "q' of the tip"),
        v.arrow((250, 150), (205, 150), INK),
        v.text((194, 150), "n"),
        v.text((90, 45), "body i"),
        v.text((315, 70), "body j"),
        label((230, 300), "s > 0 open, s = 0 impact; s' = (∂s/∂q) q' < 0 before it, −e s' after it", 13),
    ]
    return sheet(480, 330, "Impact between bodies", parts)


def fig04_nomenclature() -> str:
    """The mechanism at its start, from Table 1 and section 5."""
    v = View((215, 300), 1500)
    gamma = gamma_on_slope(90)
    hinge = (HINGES, 0.0)
    pin = polar(hinge, CRANK, PHI)
    tip = polar(pin, PAWL, gamma)
    root = polar((0.0, 0.0), RADIUS, PSI)
    parts = [
        v.area(wheel_points(10, 90, PSI), FILL),
        v.line([(0, 0), root], SOFT, 1.2),
        v.line([hinge, pin], INK, 5),
        v.line([pin, tip], "#8a5a00", 5),
        v.pin(pin),
        v.hinge((0, 0)),
        v.hinge(hinge),
        v.dot(root, 4, ACCENT),
        v.text(root, "P₀", -16, -8),
        v.line([(0, 0), (0.045, 0)], SOFT, 0.8, "5 3"),
        v.arc((0, 0), 0.036, 0.0, PSI, "ψ", 11),
        v.line([hinge, (HINGES + 0.05, 0)], SOFT, 0.8, "5 3"),
        v.arc(hinge, 0.036, 0.0, PHI, "φ", 11),
        v.line([pin, (pin[0] + 0.045, pin[1])], SOFT, 0.8, "5 3"),
        v.arc(pin, 0.026, 0.0, gamma, "γ", 12),
        v.size((0, 0), hinge, "d = 0.130", -58),
        v.text(((hinge[0] + pin[0]) / 2, pin[1] / 2), "a = 0.110", 40, 22),
        v.text(((pin[0] + tip[0]) / 2, (pin[1] + tip[1]) / 2), "b = 0.100", 0, 17),
        v.text((root[0] / 2, root[1] / 2), "r = 0.100", -38),
        v.arc(hinge, 0.062, PHI - 0.5, PHI + 0.25, ""),
        v.text(polar(hinge, 0.074, PHI - 0.35), "1 N mm", 22),
        v.text((-0.035, -0.062), "spring 15 N mm/rad"),
        label(
            (265, 530),
            f"start: φ = 77°, ψ = 75°, γ = {gamma / _DEG:.2f}° solved at nt = 10, β₀ = 90°; lengths in m",
            13,
        ),
    ]
    return sheet(560, 555, "Nomenclature", parts)


def fig05_tooth() -> str:
    """One tooth between its roots, nt = 10, beta_0 = 90 deg, with its lengths and angles."""
    shape = tooth(10, 90)
    up = math.pi / 2 + float(shape.pitch) / 2
    v = View((270, 640), 4300)

    def turned(point: Point) -> Point:
        c, s = math.cos(up), math.sin(up)
        return c * point[0] - s * point[1], s * point[0] + c * point[1]

    p0 = turned((RADIUS, 0.0))
    apex = turned((float(shape.apex[0]), float(shape.apex[1])))
    p1 = turned((RADIUS * math.cos(float(shape.pitch)), -RADIUS * math.sin(float(shape.pitch))))
    inner = [polar((0, 0), RADIUS * 0.66, up), polar((0, 0), RADIUS * 0.66, up - float(shape.pitch))]
    slope = math.atan2(apex[1] - p0[1], apex[0] - p0[0])
    chord = math.atan2(p1[1] - p0[1], p1[0] - p0[0])
    parts = [
        v.area([inner[0], p0, apex, p1, inner[1]], FILL),
        v.line([p0, p1], SOFT, 1.1, "6 4"),
        v.size(p0, apex, "L = 1.115 h", 26),
        v.size(p0, p1, "h", -24),
        v.text(((apex[0] + p1[0]) / 2, (apex[1] + p1[1]) / 2), "F", 16),
        v.arc(p0, 0.0125, up + math.pi, slope + 2 * math.pi, "β₀", 12),
        v.arc(p0, 0.026, chord, slope, "α₂", 13),
        v.arc(apex, 0.011, slope + math.pi, math.atan2(p1[1] - apex[1], p1[0] - apex[0]) + 2 * math.pi, "α", 12),
        v.arc((0, 0.046), 0.012, up, up - float(shape.pitch), "θ", 12),
        v.dot(p0),
        v.dot(p1),
        v.dot(apex),
        v.text(p0, "P₀", -18, 2),
        v.text(p1, "P₁", 18, 4),
        v.text(apex, "T", 4, -14),
        label((270, 440), "inner radius r; nt = 10, β₀ = 90°; θ at the wheel's hinge, drawn nearer", 13),
    ]
    return sheet(540, 465, "Ratchet wheel tooth", parts)


def fig06_beam() -> str:
    """The wedge as a cantilever."""
    v = View((90, 180), 1.0)
    length, height = 300.0, 130.0
    parts = [
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
    ]
    return sheet(480, 310, "Cantilever beam model", parts)


def fig07_shapes() -> str:
    """Both shapes with what the wedge leaves out."""
    parts = [
        *_shape_of(10, 90, View((30, 270), 4300), "l = F"),
        *_shape_of(10, 105, View((365, 270), 3900), "l = L cos α"),
    ]
    return sheet(700, 345, "Shapes of ratchet wheel tooth", parts)


def _shape_of(count: int, angle: float, v: View, named: str) -> list[str]:
    """The tooth on its chord, the triangle that is the beam, and the rest in grey."""
    shape = tooth(count, angle)
    h, side, a2 = float(shape.chord), float(shape.slope_length), float(shape.chord_angle)
    alpha, beam = float(shape.apex_angle), float(shape.beam_length)
    p0, p1 = (0.0, 0.0), (h, 0.0)
    apex = side * math.cos(a2), side * math.sin(a2)
    face = (p1[0] - apex[0]) / float(shape.face_length), (p1[1] - apex[1]) / float(shape.face_length)
    foot = apex[0] + beam * face[0], apex[1] + beam * face[1]
    # across the beam at its root, towards the slope
    along = math.cos(a2 + math.pi), math.sin(a2 + math.pi)
    reach = beam / math.cos(alpha)
    corner = apex[0] + reach * along[0], apex[1] + reach * along[1]
    return [
        v.area([p0, apex, p1], GREY),
        v.area([corner, apex, foot], FILL),
        v.size(apex, foot, named, 24),
        v.arc(apex, 0.008, a2 + math.pi, math.atan2(face[1], face[0]) + 2 * math.pi, "α", 11),
        v.arc(p0, 0.012, 0.0, a2, "α₂", 13),
        v.text(p0, "P₀", -4, 15),
        v.text(p1, "P₁", 6, 15),
        v.text(apex, "T", 0, -13),
        v.text(
            (h / 2, 0),
            f"β₀ = {angle:g}°: α* = {alpha_star(count, angle):.2f}° {'<' if named == 'l = F' else '≥'} 90°",
            0,
            50,
            13,
        ),
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

    def middle(k: int) -> float:
        kind, lines = _PROCEDURE[k]
        return tops[k] + box_height(lines, kind) / 2

    end_y = middle(5)
    parts += [
        # no change: end of the step
        flow(
            [(right, end_y), (right + 70, end_y), (right + 70, middle(3)), (right, middle(3))],
            "no",
            (right + 16, end_y - 12),
        ),
        label((_MIDDLE + 20, tops[6] - 13), "yes", 12.5),
        flow(
            [(left, middle(7)), (left - 55, middle(7)), (left - 55, middle(2)), (left, middle(2))],
            "no",
            (left - 14, middle(7) - 12),
        ),
        label((_MIDDLE + 20, tops[8] - 13), "yes", 12.5),
        flow([(right, middle(8)), (right + 110, middle(8)), (right + 110, middle(2)), (right, middle(2))]),
        label((_MIDDLE, bottom + 26), "until the stop time; an FMU returns at each communication point", 13),
    ]
    return sheet(560, int(bottom + 50), "What the program does: motion with impacts", parts)


def fig03_stress() -> str:
    """From an impact to the largest stress."""
    parts, _, bottom = _column(_STRESS)
    return sheet(500, int(bottom + 20), "What the program does: stress recovery", parts)


def _column(boxes: Sequence[tuple[str, tuple[str, ...]]]) -> tuple[list[str], list[float], float]:
    """Boxes below each other with arrows between, where each begins, and where the last ends [px]."""
    parts: list[str] = []
    tops: list[float] = []
    y = 16.0
    last: Point | None = None
    for kind, lines in boxes:
        if last is not None:
            parts.append(flow([last, (_MIDDLE, y)]))
        tops.append(y)
        parts.append(box(_MIDDLE, y, _WIDTH, lines, kind))
        y += box_height(lines, kind)
        last = (_MIDDLE, y)
        y += _GAP
    return parts, tops, y - _GAP
