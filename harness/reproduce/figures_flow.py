"""Figs 2 and 3 of Pennestrì, Valentini, Vita: flow charts of what this project's program does."""

from __future__ import annotations

from collections.abc import Sequence

from .drawing import Point, box, box_height, flow, label, sheet

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
