"""A mechanism's logic as tables and as a statechart."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from textwrap import wrap

from .records import Logic, Region, Transition

#: Headings of `rows`.
HEADINGS = ("Part", "From", "Event", "Guard", "To", "Reset")
#: Headings of `definition_rows`.
DEFINITION_HEADINGS = ("Logical function", "is 1 when", "Unit", "Decided within", "Event")


def rows(logic: Logic, counts: Mapping[int, int] | None = None) -> list[list[str]]:
    """The transitions, a row each, with the columns of `HEADINGS`; with `counts`, one more: how often it happened.

    Args:
        logic: of a mechanism or a file.
        counts: how often each transition happened, by its place in the logic; None leaves that out.
    """
    return [
        [t.part, t.source, t.trigger, t.condition, t.target, t.reset]
        + ([] if counts is None else [str(counts.get(place, 0))])
        for place, t in enumerate(logic.transitions)
    ]


def definition_rows(logic: Logic) -> list[list[str]]:
    """The logical functions, a row each, with the columns of `DEFINITION_HEADINGS`.

    Args:
        logic: of a mechanism or a file.
    """
    return [[d.name, d.meaning, d.unit, d.tolerance, d.event] for d in logic.definitions]


def definitions_table(logic: Logic) -> str:
    """The logical functions as Markdown.

    Args:
        logic: of a mechanism or a file.
    """
    return _markdown(DEFINITION_HEADINGS, definition_rows(logic), code=(0, 4))


def markdown(logic: Logic, counts: Mapping[int, int] | None = None) -> str:
    """The transitions as Markdown, and what never changes.

    Args:
        logic: of a mechanism or a file.
        counts: how often each transition happened, by its place in the logic; None leaves that out.
    """
    headings = HEADINGS if counts is None else (*HEADINGS, "Times")
    kept = "".join(f"\n`{name}` is closed throughout.\n" for name in kept_parts(logic))
    return _markdown(headings, rows(logic, counts), code=(2, 3)) + kept


def kept_parts(logic: Logic) -> list[str]:
    """The parts that have one state and no transition.

    Args:
        logic: of a mechanism or a file.
    """
    moving = {t.part for t in logic.transitions}
    return [region.part for region in logic.regions if region.part not in moving]


def _markdown(headings: Sequence[str], table: Iterable[Sequence[str]], code: Sequence[int]) -> str:
    def line(cells: Iterable[str]) -> str:
        return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |\n"

    body = (line(f"`{c}`" if i in code and c else c for i, c in enumerate(row)) for row in table)
    return line(headings) + line("---" for _ in headings) + "".join(body)


# A mechanism's logic as a statechart: one region for each part, beside each other in time, drawn below each other.

# Lengths in SVG units, which are pixels at scale 1.
_CHARACTER = 6.65  # width of a monospaced letter of 11
_LINE = 15
_LETTERS = 46  # of a label's line
_BOX, _BOX_HEIGHT = 96, 46
_LOOP = 34  # how far a self-loop stands out
_EDGE = 20  # between the frame and what is inside
_LEAST_WAY = 150  # between two boxes
_ARROWS_APART = 20
_TITLE = 46

#: Selectors are led by the class of the picture, because a style in a page acts on the whole page.
_STYLE = "".join(
    f"{','.join(f'svg.statechart {selector}' for selector in selectors.split(','))}{{{rules}}}"
    for selectors, rules in (
        ("text", "font:11px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;fill:#1c2733"),
        ("text.part", "font-weight:700;font-size:14px"),
        ("text.guard,.kind", "fill:#5b6875"),
        ("text.event", "font-weight:700"),
        ("text.state", "font-size:13px;font-weight:600;text-anchor:middle"),
        ("rect.frame", "fill:#fff;stroke:#8793a0"),
        ("rect.box", "fill:#eef3f7;stroke:#1c2733;stroke-width:1.4"),
        ("path.arrow", "fill:none;stroke:#1c2733;stroke-width:1.4"),
        ("path.rule", "fill:none;stroke:#8793a0;stroke-dasharray:6 5"),
        (".never text.event,.never text.guard", "fill:#8d98a3"),
        ("path.never", "stroke:#b6c0ca"),
        (".live text.event", "fill:#0072B2"),
        ("path.live", "stroke:#0072B2;stroke-width:2.4"),
    )
)

_HEAD = (
    '<defs><marker id="statechart-head" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="9" markerHeight="9" '
    'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0L10 5L0 10z" fill="#1c2733"/></marker></defs>'
)


@dataclass(frozen=True)
class _Row:
    """A region with the labels of its arrows, by (source, target)."""

    region: Region
    labels: Mapping[tuple[str, str], Sequence[tuple[Transition, int | None]]]

    def block(self, source: str, target: str) -> list[tuple[str, str]]:
        """Lines (text, css class) of the labels of one arrow."""
        return [line for arrow in self.labels.get((source, target), ()) for line in _lines(*arrow)]


def diagram(logic: Logic, counts: Mapping[int, int] | None = None) -> str:
    """The state charts as a self-contained SVG document: the same text for the same logic.

    Args:
        logic: of the mechanism.
        counts: how often each transition happened, by its place; None when nothing ran.
    """
    regions = [_row(region, logic, counts) for region in logic.regions]
    left = max((_width(row.block(row.region.states[0], row.region.states[0])) for row in regions), default=0.0)
    right = max((_width(_second_loop(row)) for row in regions), default=0.0)
    way = max((_way(row) for row in regions), default=_LEAST_WAY)
    first = _EDGE + (left + _LOOP + 8 if left else 0) + 8
    width = first + 2 * _BOX + way + (right + _LOOP + 8 if right else 0) + _EDGE + 8
    titles = (_CHARACTER * (1.3 * len(r.region.part) + len(r.region.kind) + 3) + 2 * _EDGE for r in regions)
    width = max(width, *titles) if regions else width
    parts: list[str] = []
    y = 0.0
    for row in regions:
        if y:
            parts.append(f'<path class="rule" d="M1 {y:g}H{width - 1:g}"/>')
        drawn, height = _draw(row, first, way, y)
        parts += drawn
        y += height
    size = f'viewBox="-1 -1 {width + 2:g} {y + 2:g}" width="{width + 2:g}" height="{y + 2:g}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="statechart" style="max-width:100%;height:auto" {size} '
        f'role="img"><title>Modes and transitions</title><style>{_STYLE}</style>{_HEAD}\n'
        f'<rect class="frame" width="{width:g}" height="{y:g}" rx="12"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


def _row(region: Region, logic: Logic, counts: Mapping[int, int] | None) -> _Row:
    labels: dict[tuple[str, str], list[tuple[Transition, int | None]]] = {}
    for place, arrow in enumerate(logic.transitions):
        if arrow.part == region.part:
            count = None if counts is None else counts.get(place, 0)
            labels.setdefault((arrow.source, arrow.target), []).append((arrow, count))
    return _Row(region, labels)


def _lines(arrow: Transition, count: int | None) -> Iterator[tuple[str, str]]:
    """A transition as lines: event and count, guard, reset."""
    tone = "" if count is None else "live" if count else "never"
    yield arrow.trigger + (f"  ×{count}" if count else ""), f"{tone} event"
    texts = [f"[{arrow.condition}]" if arrow.condition != arrow.event else "", f"/ {arrow.reset}"]
    for text in texts:
        if len(text) > 2:
            yield from ((line, f"{tone} guard") for line in wrap(text, _LETTERS))


def _second_loop(row: _Row) -> list[tuple[str, str]]:
    states = row.region.states
    return row.block(states[1], states[1]) if len(states) > 1 else []


def _way(row: _Row) -> float:
    """How far the two boxes of a region must be apart."""
    states = row.region.states
    if len(states) < 2:
        return _LEAST_WAY
    return max(_LEAST_WAY, 28 + max(_width(row.block(*pair)) for pair in (states[:2], states[1::-1])))


def _width(lines: Sequence[tuple[str, str]]) -> float:
    return _CHARACTER * max((len(text) for text, _ in lines), default=0)


def _draw(row: _Row, first: float, way: float, top: float) -> tuple[list[str], float]:
    """The elements of a region that begins at `top`, and its height."""
    states = row.region.states
    there = row.block(*states[:2]) if len(states) > 1 else []
    back = row.block(*states[1::-1]) if len(states) > 1 else []
    loops = [row.block(states[0], states[0]), _second_loop(row)]
    half = max(_BOX_HEIGHT / 2, *(len(loop) * _LINE / 2 for loop in loops))
    above = max(half, _ARROWS_APART / 2 + len(there) * _LINE)
    below = max(half, _ARROWS_APART / 2 + len(back) * _LINE + 6)
    middle = top + _TITLE + above
    title = (
        f'<text class="part" x="{_EDGE}" y="{top + 26:g}">{escape(row.region.part)}'
        f'<tspan class="kind" dx="10" font-size="11" font-weight="400">{escape(row.region.kind)}</tspan></text>'
    )
    parts = [title]
    places = [first, first + _BOX + way]
    for x, state, loop, side in zip(places, states, loops, (-1, 1), strict=False):
        if loop:
            parts += _loop(x, middle, side, loop, _tone(row, state, state))
        parts.append(_box(x, middle, state, state == row.region.start and len(states) > 1))
    if len(states) > 1:
        left, right = first + _BOX, places[1]
        y = middle - _ARROWS_APART / 2
        if there:
            parts.append(_arrow(f"M{left:g} {y:g}H{right:g}", _tone(row, *states[:2])))
            parts += _text(there, left + 14, y - 6 - (len(there) - 1) * _LINE)
        y = middle + _ARROWS_APART / 2
        if back:
            parts.append(_arrow(f"M{right:g} {y:g}H{left:g}", _tone(row, *states[1::-1])))
            parts += _text(back, left + 14, y + 14)
    return parts, _TITLE + above + below + _EDGE


def _tone(row: _Row, source: str, target: str) -> str:
    counts = [count for _, count in row.labels.get((source, target), ())]
    if not counts or counts[0] is None:
        return ""
    return "live" if any(counts) else "never"


def _box(x: float, middle: float, state: str, is_start: bool) -> str:
    y = middle - _BOX_HEIGHT / 2
    start = ""
    if is_start:
        start = f'<circle cx="{x + 6:g}" cy="{y - 15:g}" r="4.5"/>' + _arrow(
            f"M{x + 6:g} {y - 12:g}Q{x + 12:g} {y - 8:g} {x + 20:g} {y:g}", ""
        )
    return (
        f'<rect class="box" x="{x:g}" y="{y:g}" width="{_BOX}" height="{_BOX_HEIGHT}" rx="12"/>'
        f'<text class="state" x="{x + _BOX / 2:g}" y="{middle + 5:g}">{escape(state)}</text>{start}'
    )


def _loop(x: float, middle: float, side: int, lines: Sequence[tuple[str, str]], tone: str) -> list[str]:
    edge = x if side < 0 else x + _BOX
    out = edge + side * _LOOP
    path = f"M{edge:g} {middle - 11:g}C{out:g} {middle - 26:g} {out:g} {middle + 26:g} {edge:g} {middle + 11:g}"
    start = out + side * 2 - (_width(lines) if side < 0 else 0)
    return [_arrow(path, tone), *_text(lines, start, middle - (len(lines) - 1) * _LINE / 2 + 4)]


def _arrow(path: str, tone: str) -> str:
    return f'<path class="{f"arrow {tone}".strip()}" d="{path}" marker-end="url(#statechart-head)"/>'


def _text(lines: Sequence[tuple[str, str]], x: float, y: float) -> Iterator[str]:
    for number, (text, css) in enumerate(lines):
        tone, _, kind = css.rpartition(" ")
        yield f'<g class="{tone}"><text class="{kind}" x="{x:g}" y="{y + number * _LINE:g}">{escape(text)}</text></g>'
