"""The pictures of docs/explanation/friction.md; here the first: the cone of the contact force, friction over slip.

python -m docs.drawings.friction_drawing      rewrites docs/explanation/friction*.svg, in the root of a clone
"""

from __future__ import annotations

import math
from pathlib import Path

from docs.joints.sketch import ACCENT, AXIS, BODY_I, BODY_J, LINE, THIN, Sketch, add

from .friction_cases_drawing import cases_drawing
from .friction_impact_drawing import impact_drawing
from .friction_modes_drawing import modes_drawing
from .friction_runs_drawing import runs_drawing
from .painleve_drawing import painleve_drawing
from .pictures import Point, sheet

PICTURES = Path(__file__).parents[1] / "explanation"

#: Of the picture: mu = tan(rho).
RHO = math.radians(26)
_BOLD = f'fill="none" stroke="{ACCENT}" stroke-width="3"'
_SHADE = 'fill="#e9c46a" fill-opacity="0.35" stroke="#7b8794" stroke-width="1"'


def _cone(s: Sketch) -> list[str]:
    """A block on a line; the force on it is within the cone."""
    foot: Point = (1.6, 0.7)
    high = 1.7
    reach = high * math.tan(RHO)
    force = (-0.38, 1.35)
    return [
        s.box((1.6, 0.5), 3.2, 0.4, 0.0, BODY_J),
        s.box(add(foot, (0.0, 0.3)), 1.9, 0.6, 0.0, BODY_I),
        s.path([foot, add(foot, (-reach, high)), add(foot, (reach, high))], _SHADE, closed=True),
        s.path([foot, add(foot, (0.0, high + 0.15))], AXIS),
        s.vector(foot, add(foot, force), "λ", -14, 0, 0.75),
        s.path([add(foot, (0.0, force[1])), add(foot, force)], THIN),
        s.text(add(foot, (0.5 * force[0], force[1])), "λ^T", 0, -14),
        s.path([add(foot, (0.0, force[1])), foot], THIN),
        s.text(add(foot, (0.0, 0.5 * force[1])), "λ^N", 18, 0),
        s.text(add(foot, (0.0, high)), "± μ λ^N", 0, -18),
        s.vector(add(foot, (1.05, 0.3)), add(foot, (1.75, 0.3)), "v^T", 0, -14),
    ]


def _law(s: Sketch) -> list[str]:
    """Minus friction over the slip speed: a step with an upright part."""
    o: Point = (5.6, 1.45)
    wide, high = 1.5, 0.8
    return [
        s.vector(add(o, (-wide, 0.0)), add(o, (wide + 0.2, 0.0)), "v^T", 0, 20, 0.95),
        s.vector(add(o, (0.0, -1.15)), add(o, (0.0, 1.3)), "−λ^T", -28, 6, 0.97),
        s.path([add(o, (-wide, -high)), add(o, (0.0, -high))], _BOLD),
        s.path([add(o, (0.0, high)), add(o, (wide, high))], _BOLD),
        s.path([add(o, (0.0, -high - 0.22)), add(o, (0.0, high + 0.22))], _BOLD),
        s.path([add(o, (-0.06, high + 0.22)), add(o, (0.06, high + 0.22))], LINE),
        s.path([add(o, (-0.06, -high - 0.22)), add(o, (0.06, -high - 0.22))], LINE),
        s.text(add(o, (0.0, high + 0.22)), "μₛ λ^N", 40, 0),
        s.text(add(o, (0.0, high)), "μ λ^N", -34, 0),
        s.note(add(o, (0.85, high - 0.22)), "slips forwards"),
        s.note(add(o, (-0.88, -high - 0.2)), "slips backwards"),
        s.note(add(o, (0.4, 0.28)), "sticks"),
    ]


def law_drawing() -> str:
    """The picture as SVG text."""
    s = Sketch((20, 300), 100)
    return sheet(760, 320, "Friction: the cone of the contact force, and friction over slip", [*_cone(s), *_law(s)])


#: Of each file, without .svg: what draws it.
DRAWINGS = {
    "friction": law_drawing,
    "friction_modes": modes_drawing,
    "friction_runs": runs_drawing,
    "friction_impact": impact_drawing,
    "friction_painleve": painleve_drawing,
    "friction_cases": cases_drawing,
}


def main() -> None:
    """Rewrite all pictures."""
    for name, draw in DRAWINGS.items():
        (PICTURES / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
