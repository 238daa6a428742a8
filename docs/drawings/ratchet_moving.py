"""The moving picture of README.md: the free ratchet over one stroke, from a run, as an SVG file that moves by itself.

python -m docs.drawings.ratchet_moving      rewrites docs/ratchet_moving.svg, in the root of a clone
"""

from __future__ import annotations

import math
from pathlib import Path

from mechanism_fmu.model.sawtooth import wheel_outline
from mechanism_fmu.simulation import Result, simulate
from models.ratchet.model import MODEL
from models.ratchet.start import tooth

from .pictures import INK

PICTURE = Path(__file__).parents[1] / "ratchet_moving.svg"
#: The model's own case, and the period of its swing [s].
CASE = next(case for case in MODEL.cases if case.name == "indexing")
PERIOD = 8.0
#: The second stroke is shown, as the first starts from rest: in which time [s], by how many pictures.
SHOWN, FRAMES = 4.0, 100
_GIVEN = {name: value for name, value in CASE.values.items() if name in {p.name for p in MODEL.parameters}}
_SCALE, _MIDDLE = 1500.0, (190.0, 180.0)  # px/m, place of the wheel's hinge [px]


def run() -> Result:
    """Two strokes: the far end of the crank's shaft swings forwards and back."""
    inputs = {name: value for name, value in CASE.values.items() if name not in _GIVEN}
    inputs |= {name: signal.at for name, signal in CASE.signals.items()}
    mechanism = MODEL.build(MODEL.values(**_GIVEN))
    outputs = ["wheel_angle", "crank_angle", "pawl_angle", "clicks"]
    return simulate(mechanism, until=2 * PERIOD, step=5e-3, outputs=outputs, inputs=inputs)


def drawing(result: Result) -> str:
    """The picture: wheel, crank and pawl, each turned by a list of angles."""
    values = MODEL.values(**_GIVEN)
    times = [PERIOD * (1 + k / FRAMES) for k in range(FRAMES + 1)]
    rows = [result.at(time) for time in times]
    wheel, crank, pawl = ([row[f"{name}_angle"] for row in rows] for name in ("wheel", "crank", "pawl"))
    one = tooth(values)
    outline = " ".join(
        f"{_SCALE * x:.1f},{-_SCALE * y:.1f}" for x, y in wheel_outline(one, 20, values.wheel_inner_radius)
    )
    hinge, long, reach = (
        _SCALE * length for length in (values.hinge_distance, values.crank_length, values.pawl_length)
    )
    return "\n".join(
        [
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 480 360" width="480" height="360" role="img" '
            'aria-label="A ratchet indexes one tooth">',
            f'<g transform="translate({_MIDDLE[0]:g} {_MIDDLE[1]:g})" stroke="{INK}" stroke-width="1.5">',
            f'<g><polygon points="{outline}" fill="#cfd8e3"/>{_turning(wheel)}</g>',
            f'<g transform="translate({hinge:.1f} 0)"><g>{_bar(long, "#2b7a78")}',
            f'<g transform="translate({long:.1f} 0)"><g>{_bar(reach, "#d9731a")}',
            f"{_turning([p - c for p, c in zip(pawl, crank, strict=True)])}</g></g>{_turning(crank)}</g></g>",
            *(f'<circle cx="{x:.1f}" r="5" fill="#fff"/>' for x in (0.0, hinge)),
            "</g></svg>\n",
        ]
    )


def _bar(length: float, colour: str) -> str:
    return f'<line x2="{length:.1f}" stroke="{colour}" stroke-width="9" stroke-linecap="round"/>'


def _turning(angles: list[float]) -> str:
    """Angles [rad] as the turning of the group that this stands in; y points down on the sheet."""
    listed = ";".join(f"{-math.degrees(angle):.2f}" for angle in angles)
    return (
        f'<animateTransform attributeName="transform" type="rotate" values="{listed}" dur="{SHOWN:g}s" '
        'repeatCount="indefinite"/>'
    )


if __name__ == "__main__":
    PICTURE.write_text(drawing(run()), encoding="utf-8")
