"""Slider-crank with clearance: in the guide of its slider, as Flores, Leine and Glocker have it, or in the pin.

In the guide, crank theta, rod phi and slider delta are coordinates: the slider's centre is where the rod ends, (x, y) =
l1 e(theta) + l2 e(phi), and its corners (+-a, +-b) have from the guide, c away on either side, the gaps

    g = c + b -+ (y +- a sin(delta)) - b cos(delta),                                                        (1)

and slip along x. With play in the pin, x of a slider that keeps straight takes the place of delta, and the gap is

    g = c - |l1 e(theta) + l2 e(phi) - (x, 0)|.                                                             (2)

Between impacts M q'' + h = 0; an impact leaves g'+ = -e g'-, with friction against the slip.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import numpy.typing as npt

from harness.report.plot import Curve, Plot
from mechanism_fmu.model import GROUND, Body, Mechanism, Outline, OutlineContact, Output, Revolute, Settings
from mechanism_fmu.simulation import simulate

from ..case import Case, Known, Run, example
from ..flights import impacts

CRANK, ROD, GRAVITY, SPEED = 0.153, 0.306, 9.81, 150.0
CRANK_MASS, ROD_MASS, SLIDER_MASS = 0.038, 0.038, 0.076
CRANK_INERTIA, ROD_INERTIA, SLIDER_INERTIA = 7.4e-5, 5.9e-4, 2.7e-6
#: Half of the slider's length and height, and the play of slider and pin [m].
LENGTH, HEIGHT, PLAY, PIN_PLAY = 0.05, 0.025, 1e-3, 0.5e-3
SPIN, FRICTION = -0.01, 0.01
Vector = npt.NDArray[np.float64]


def slider_crank(
    slider: Body, joints: tuple[Any, ...], contacts: tuple[Any, ...], rod_end: bool, tolerance: float = 1e-9
) -> Mechanism:
    """Crank and rod, stretched at first, and a slider at the end of the rod: pinned to it, or not."""
    crank = Body("crank", CRANK_MASS, CRANK_INERTIA, (CRANK / 2, 0.0, 0.0), start_rate=(0.0, SPEED * CRANK / 2, SPEED))
    rate = (0.0, SPEED * CRANK - SPEED / 2 * ROD / 2, -SPEED / 2)
    rod = Body("rod", ROD_MASS, ROD_INERTIA, (CRANK + ROD / 2, 0.0, 0.0), start_rate=rate)
    pins = [
        Revolute("main", crank.at(-CRANK / 2, 0.0), GROUND),
        Revolute("crank_pin", crank.at(CRANK / 2, 0.0), rod.at(-ROD / 2, 0.0)),
    ]
    if rod_end:
        pins.append(Revolute("piston_pin", rod.at(ROD / 2, 0.0), slider.at(0.0, 0.0)))
    return Mechanism(
        (crank, rod, slider),
        (*pins, *joints),
        contacts=contacts,
        gravity=(0.0, -GRAVITY),
        settings=Settings(tolerance),
    )


def in_guide(restitution: float, spin: float, friction: float, tolerance: float = 1e-9) -> Mechanism:
    """The slider is a block of 100 x 50 mm, with 1 mm to a guide on either side, and turns at `spin` [rad/s]."""
    start, rate = (CRANK + ROD, 0.0, 0.0), (0.0, 0.0, spin)
    slider = Body("slider", SLIDER_MASS, SLIDER_INERTIA, start, start_rate=rate)
    corners = [(LENGTH, HEIGHT), (-LENGTH, HEIGHT), (-LENGTH, -HEIGHT), (LENGTH, -HEIGHT)]
    wall = HEIGHT + PLAY
    contacts = tuple(
        OutlineContact(
            name,
            slider,
            GROUND,
            outline_i=Outline.polygon(corners),
            outline_j=Outline.chain(points),
            restitution=restitution,
            friction=friction,
            points=2,
        )
        for name, points in (("bottom", [(1.0, -wall), (-1.0, -wall)]), ("top", [(-1.0, wall), (1.0, wall)]))
    )
    return slider_crank(slider, (), contacts, rod_end=True, tolerance=tolerance)


def with_play(restitution: float, tolerance: float) -> Mechanism:
    """The mechanism of docs/examples/gallery/slider_crank_clearance.py."""
    model = example("slider_crank_clearance")
    changed = {"restitution": restitution, "relative_tolerance": tolerance}
    mechanism: Mechanism = model.build(SimpleNamespace(**vars(model.values()) | changed))
    return mechanism


def _unit(angle: float) -> Vector:
    return np.array([math.cos(angle), math.sin(angle)])


class Linkage:
    """Crank and rod in their angles [rad], and a third coordinate of the slider.

    Args:
        carried: mass that the rod carries at its end [kg].
        third: inertia of the third coordinate [kg or kg m2].
        start: state (6,).
    """

    def __init__(self, carried: float, third: float, start: Sequence[float]) -> None:
        self.carried, self.third, self.start = carried, third, np.array(start)

    def free(self, y: Vector) -> tuple[Vector, Vector]:
        """Accelerations of flight (3,), and the inverse of the mass matrix (3, 3)."""
        theta, phi = y[:2]
        end = self.carried
        both = (ROD_MASS / 2 + end) * CRANK * ROD
        mass = np.zeros((3, 3))
        mass[0, 0] = CRANK_INERTIA + (CRANK_MASS / 4 + ROD_MASS + end) * CRANK**2
        mass[0, 1] = mass[1, 0] = both * math.cos(theta - phi)
        mass[1, 1], mass[2, 2] = ROD_INERTIA + (ROD_MASS / 4 + end) * ROD**2, self.third
        swing = both * math.sin(theta - phi)
        crank_weight = GRAVITY * (CRANK_MASS / 2 + ROD_MASS + end) * CRANK * math.cos(theta)
        rod_weight = GRAVITY * (ROD_MASS / 2 + end) * ROD * math.cos(phi)
        force = np.array([-swing * y[4] ** 2 - crank_weight, swing * y[3] ** 2 - rod_weight, 0.0])
        inverse = np.linalg.inv(mass)
        acceleration: Vector = inverse @ force
        return acceleration, np.asarray(inverse, np.float64)


class Guide(Linkage):
    """The slider in its guide: gaps of eq (1), rear and front corner on top, then those below."""

    _corners = ((-1, 1), (1, 1), (-1, -1), (1, -1))

    def __init__(self) -> None:
        super().__init__(SLIDER_MASS, SLIDER_INERTIA, (0.0, 0.0, 0.0, SPEED, -SPEED / 2, SPIN))

    def gaps(self, y: Vector) -> Sequence[float]:
        """All of them [m]."""
        theta, phi, delta = y[:3]
        height, sine, cosine = CRANK * math.sin(theta) + ROD * math.sin(phi), math.sin(delta), math.cos(delta)
        return [PLAY + HEIGHT - side * (height + end * LENGTH * sine) - HEIGHT * cosine for end, side in self._corners]

    def rows(self, y: Vector, number: int) -> tuple[Vector, Vector]:
        """Derivatives of a corner's gap, and of its place along the guide (3,)."""
        theta, phi, delta = y[:3]
        end, side = self._corners[number]
        sine, cosine = math.sin(delta), math.cos(delta)
        up = np.array([CRANK * math.cos(theta), ROD * math.cos(phi), end * LENGTH * cosine - side * HEIGHT * sine])
        along = np.array(
            [-CRANK * math.sin(theta), -ROD * math.sin(phi), -end * LENGTH * sine - side * HEIGHT * cosine]
        )
        return -side * up, along


class Pin(Linkage):
    """The slider's pin in its hole in the rod: the gap of eq (2), and no friction."""

    def __init__(self) -> None:
        super().__init__(0.0, SLIDER_MASS, (0.0, 0.0, CRANK + ROD, SPEED, -SPEED / 2, 0.0))

    def row(self, y: Vector) -> tuple[float, Vector, float]:
        """Gap [m], its derivative by the coordinates (3,), and what of its second derivative rates make [m/s2]."""
        theta, phi, x = y[:3]
        out = np.array([x, 0.0]) - CRANK * _unit(theta) - ROD * _unit(phi)
        across = np.array(
            [[CRANK * math.sin(theta), ROD * math.sin(phi), 1.0], [-CRANK * math.cos(theta), -ROD * math.cos(phi), 0.0]]
        )
        distance = math.hypot(*out) or 1e-300  # in the middle of the hole, where no direction is needed
        normal, speed = out / distance, across @ y[3:]
        turning = CRANK * _unit(theta) * y[3] ** 2 + ROD * _unit(phi) * y[4] ** 2
        bend = (speed @ speed - (normal @ speed) ** 2) / distance
        return PIN_PLAY - distance, -normal @ across, -float(normal @ turning + bend)

    def gaps(self, y: Vector) -> Sequence[float]:
        """The one [m]."""
        theta, phi, x = y[:3]
        across = x - CRANK * math.cos(theta) - ROD * math.cos(phi)
        return [PIN_PLAY - math.hypot(across, CRANK * math.sin(theta) + ROD * math.sin(phi))]

    def rows(self, y: Vector, number: int) -> tuple[Vector, Vector]:
        """Its derivatives (3,); nothing slips."""
        assert number == 0
        row = self.row(y)[1]
        return row, np.zeros_like(row)


#: The second formulation, restitution, friction, and the impacts that are looked at.
_GUIDE, _PIN, _LIVELY = "slider in its guide, e = 0.4", "pin in its hole, e = 0.4", "pin in its hole, e = 0.8"
_WATCHED: dict[str, tuple[type[Guide] | type[Pin], float, float, tuple[int, ...]]] = {
    _GUIDE: (Guide, 0.4, FRICTION, (1, 2, 4, 6, 8)),
    _PIN: (Pin, 0.4, 0.0, (1, 2, 4, 6)),
    _LIVELY: (Pin, 0.8, 0.0, (1, 2, 4, 6, 8)),
}


def second_formulation() -> list[tuple[float, float]]:
    """Times [s] and closing speeds [m/s] of the impacts that are looked at."""
    found = []
    for kind, restitution, friction, chosen in _WATCHED.values():
        struck = impacts(kind(), restitution, chosen[-1], friction)
        found += [(struck[k - 1].time, struck[k - 1].speed) for k in chosen]
    return found


#: By `second_formulation`, which takes too long to be asked each time.
FOUND = (
    (0.002690903648407583, 0.8416338402450637),
    (0.0026922543109251136, 1.9924772196473153),
    (0.0026925056979771964, 2.4732198674429906),
    (0.0026925400505859965, 2.3327861050815155),
    (0.0026925465076739655, 2.1052480946306313),
    (0.0004409104887573118, 2.259615625224369),
    (0.0007956862153933858, 0.858714184485172),
    (0.0009709553047590092, 0.1404783069209543),
    (0.0009976997170762438, 0.02241834885845151),
    (0.0004409104887573118, 2.259615625224369),
    (0.0010815746297264403, 1.1767305363413094),
    (0.0013431773283326092, 0.8700078835477916),
    (0.0018553065051599349, 0.2839274231522544),
    (0.002276353661869315, 0.31287687629351346),
)


def run(tolerance: float) -> Run:
    """Impacts in the guide, and in the pin's hole with little and with much bounce."""
    values, steps = [], 0
    for name, (kind, restitution, friction, chosen) in _WATCHED.items():
        has_guide = kind is Guide
        made = in_guide(restitution, SPIN, friction, tolerance) if has_guide else with_play(restitution, tolerance)
        result = simulate(made, _STOPS[name], step=_STOPS[name])
        steps += result.statistics.accepted_steps
        values += [value for k in chosen for value in (result.impacts[k - 1].time, result.impacts[k - 1].closing_speed)]
    return Run(tuple(values), steps)


#: Just behind the last impacts that are looked at [s].
_STOPS = {_GUIDE: 0.0026926, _PIN: 0.000999, _LIVELY: 0.0023}


def _known() -> Iterator[Known]:
    found = iter(FOUND)
    for name, (_, _, _, chosen) in _WATCHED.items():
        for k in chosen:
            time, speed = next(found)
            yield Known(f"{name}: time of impact {k}", "s", time, "second formulation")
            yield Known(f"{name}: closing speed of impact {k}", "m/s", speed, "second formulation")


def drawings() -> Sequence[Plot]:
    """Where the slider is between the walls of its guide, over turns of the crank."""
    shown = (Output("angle", "crank.angle", "rad"), Output("height", "slider.y", "m"))
    result = simulate(replace(in_guide(0.4, SPIN, FRICTION), outputs=shown), 0.2, step=1e-4)
    curve = Curve("slider", result["angle"] / math.tau, result["height"] / PLAY, "#1f6feb")
    return [Plot("Slider in its guide, e = 0.4", "turns of the crank", "height over play", [curve], legend=False)]


CASE = Case(
    name="clearance_slider_crank",
    title="Slider-crank with clearance",
    statement=(
        "A crank of 153 mm at 150 rad/s and a rod of 306 mm, stretched at first, move a slider of 100 x 50 mm: in a "
        "guide with 1 mm of play on either side, with friction 0.01, turning at \u22120.01 rad/s at first; or kept "
        "straight, with a pin that has 0.5 mm of radial play in the rod, without friction."
    ),
    source=(
        "P. Flores, R. Leine, Ch. Glocker, Modeling and analysis of planar rigid multibody systems with translational "
        "clearance joints based on the non-smooth dynamics approach, Multibody System Dynamics 23 (2010) 165-190; "
        "data as in SliderCrank, an example of Siconos. Play in the pin: this project"
    ),
    known=tuple(_known()),
    run=run,
    model=in_guide,
    within=1e-9,
    drawings=drawings,
    remark=(
        "In the guide the corners on top strike in turn, rear and front, ever sooner: the eighth impact comes 2 ns "
        "after the seventh. The tenth would come 0.4 ns after the ninth, with the corner less than 1 nm from the "
        "guide: this engine takes both as striking at once, the second formulation does not, and what follows depends "
        "on it. So digits are held no longer; nor could they be for long, as such motion is chaotic. The reference "
        "file of the Siconos example, made with steps of time, is not compared: it tests laws, not digits."
    ),
)
