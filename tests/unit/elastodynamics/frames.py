"""Random linkages, and a plane frame by direct stiffness that knows nothing of the flexibility approach."""

import math
from dataclasses import dataclass, field

import numpy as np

from mechanism_fmu.kinematics import KinematicMotion
from mechanism_fmu.model import (
    GROUND,
    Body,
    Mechanism,
    Member,
    Revolute,
    RevoluteTranslational,
    Section,
    Translational,
)


@dataclass
class Assembly:
    """Bodies with bars between points of the plane, pinned to each other, before anyone names a frame.

    Attributes:
        bars: by body, pairs of points; none for rigid bodies.
        pins: body, body, point.
        sliders: a block that does not turn ("block") or a bare pin ("pin"), the body with the guide, the body with the
            point, the point, and the direction of the guide.
        frames: by body, the place and angle of its frame.
    """

    bars: dict[str, list[tuple[complex, complex]]] = field(default_factory=dict)
    pins: list[tuple[str, str, complex]] = field(default_factory=list)
    sliders: list[tuple[str, str, str, complex, complex]] = field(default_factory=list)
    frames: dict[str, tuple[complex, float]] = field(default_factory=dict)

    def local(self, body, point):
        if body == GROUND:
            return point.real, point.imag
        origin, angle = self.frames[body]
        turned = (point - origin) * np.exp(-1j * angle)
        return float(turned.real), float(turned.imag)

    def axis(self, body, along):
        turned = along * np.exp(-1j * self.frames[body][1]) if body != GROUND else along
        return float(turned.real), float(turned.imag)

    def mechanism(self, sections):
        bodies = [
            Body(name, 1.0, 1.0, (origin.real, origin.imag, angle)) for name, (origin, angle) in self.frames.items()
        ]
        joints = [
            Revolute(f"pin{k}", i, self.local(i, p), j, self.local(j, p)) for k, (i, j, p) in enumerate(self.pins)
        ]
        for k, (kind, base, body, point, along) in enumerate(self.sliders):
            guide = base, self.local(base, point - 0.3 * along), self.axis(base, along)
            if kind == "pin":
                joints.append(RevoluteTranslational(f"guide{k}", *guide, body, self.local(body, point)))
            else:
                axis = self.axis(body, along)
                joints.append(Translational(f"guide{k}", *guide, body, self.local(body, point), axis))
        members, each = [], iter(sections)
        for body, bars in self.bars.items():
            for k, (a, b) in enumerate(bars):
                members.append(
                    Member(f"{body}_bar{k}", body, self.local(body, a), self.local(body, b), *next(each), 0.0)
                )
        return Mechanism(tuple(bodies), tuple(joints), members=tuple(members), held=("crank.angle",))

    def motion(self, mechanism):
        position = np.array([[c for body in mechanism.bodies for c in body.start]])
        names = tuple(f"{b.name}.{c}" for b in mechanism.bodies for c in ("x", "y", "angle"))
        return KinematicMotion(names, np.zeros(1), position, np.zeros_like(position), np.zeros_like(position))

    def frame(self, sections):
        """What moves the ends of bars, (bars, 2, 3), and (N, M, M), as a function of the forces on them."""
        names = [(body, bar) for body, bars in self.bars.items() for bar in bars]
        rigid = [body for body in self.frames if not self.bars.get(body)]
        count = 6 * len(names) + 3 * len(rigid)
        stiffness, rows = np.zeros((count, count), dtype=np.longdouble), []
        ends = [(body, bar[k], 6 * n + 3 * k) for n, (body, bar) in enumerate(names) for k in (0, 1)]
        ends += [(body, None, 6 * len(names) + 3 * k) for k, body in enumerate(rigid)]
        bars = []
        for n, ((_, (a, b)), (section, young)) in enumerate(zip(names, sections, strict=True)):
            along = np.clongdouble(b) - np.clongdouble(a)
            matrix, turn = bar_stiffness(abs(along), section, young), turning(along)
            bars.append((matrix, turn))
            stiffness[6 * n : 6 * n + 6, 6 * n : 6 * n + 6] = turn.T @ matrix @ turn

        def at(body, point):
            """(u_x, u_y, theta) of a point of a body as rows for all displacements."""
            found = np.zeros((3, count))
            if body == GROUND:
                return found
            for other, place, first in ends:
                if other == body and (place is None or abs(place - point) < 1e-9):
                    found[:, first : first + 3] = np.eye(3)
                    arm = 0.0 if place is not None else 1j * (point - self.frames[body][0])
                    found[0, first + 2], found[1, first + 2] = np.real(arm), np.imag(arm)
                    return found
            raise AssertionError(f"no end of {body} at {point}")

        for body, place, first in ends:  # welds
            if place is not None:
                own = np.zeros((3, count))
                own[:, first : first + 3] = np.eye(3)
                rows.append(own - at(body, place))
        rows += [(at(i, p) - at(j, p))[:2] for i, j, p in self.pins]
        hinge = next(p for i, j, p in self.pins if {i, j} == {"crank", GROUND})
        rows.append(at("crank", hinge)[2:])
        for kind, base, body, point, along in self.sliders:
            moved = at(body, point) - at(base, point)
            rows.append((-along.imag * moved[0] + along.real * moved[1])[None])
            if kind == "block":
                rows.append(moved[2:])
        rows = np.vstack(rows)
        rows = rows[np.abs(rows).max(axis=1) > 0.0]

        def solve(forces):
            load = np.zeros(count)
            load[: forces.size] = forces.ravel()
            moved = with_constraints(stiffness, rows, load)
            inner = [matrix @ turn @ moved[6 * n : 6 * n + 6] for n, (matrix, turn) in enumerate(bars)]
            return moved[: forces.size].reshape(forces.shape), np.array([(f[3], -f[2], f[5]) for f in inner])

        return solve


def with_constraints(stiffness, rows, load):
    """U of K u + G^T x = P, G u = 0; as bars are slender, in long doubles, by solving again for what is left."""
    scale = np.abs(stiffness).max()
    exact = np.block([[stiffness / scale, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
    right, found = np.concatenate([load / scale, np.zeros(len(rows))]), np.zeros(len(exact), dtype=np.longdouble)
    for _ in range(5):
        found += np.linalg.solve(exact.astype(float), (right - exact @ found).astype(float))
    return found[: len(load)]


def bar_stiffness(length, section, young):
    """The 6x6 matrix of every textbook, along and left of the bar."""
    a, b = young * section.area / length, young * section.second_moment / length**3
    c, d, e = 12 * b, 6 * b * length, 4 * b * length**2
    return np.array(
        [
            [a, 0, 0, -a, 0, 0],
            [0, c, d, 0, -c, d],
            [0, d, e, 0, -d, e / 2],
            [-a, 0, 0, a, 0, 0],
            [0, -c, -d, 0, c, -d],
            [0, d, e / 2, 0, -d, e],
        ]
    )


def turning(along):
    c, s = along.real / abs(along), along.imag / abs(along)
    turn = np.zeros((6, 6), dtype=np.longdouble)
    for first in (0, 3):
        turn[first : first + 3, first : first + 3] = [[c, s, 0], [-s, c, 0], [0, 0, 1]]
    return turn


def random_assembly(numbers, kinds):
    """A crank, and what each of `kinds` says, hung on a body before it.

    A link with a rocker ("dyad"), with one that is rigid ("rigid"), with a block in a guide ("block") or with a bare
    pin in it ("pin"), where every other link carries a bar to a path point, welded on; a rigid arm that a pin slides in
    ("arm"); or a link to the ground too many ("brace"). `numbers` is a `numpy.random.Generator`; points are drawn until
    two links are far from flat.
    """
    made = Assembly()

    def new_body(name, *bars):
        made.bars[name] = list(bars)
        middle = bars[0][0] if bars else 0j
        made.frames[name] = (middle + complex(*numbers.normal(size=2)), float(numbers.uniform(-7, 7)))

    def point_from(origin):
        return origin + numbers.uniform(0.3, 1.5) * np.exp(1j * numbers.uniform(0, 2 * math.pi))

    hinge = complex(*numbers.normal(size=2))
    tip = point_from(hinge)
    new_body("crank", (hinge, tip) if numbers.random() < 0.5 else (tip, hinge))
    made.pins.append(("crank", GROUND, hinge))
    outputs = [("crank", tip)]
    for k, kind in enumerate(kinds):
        body, start = outputs[int(numbers.integers(len(outputs)))]
        if kind == "brace":
            body, start = outputs[-1]
            hinge = point_from(start)
            new_body(f"brace{k}", (start, hinge))
            made.pins += [(f"brace{k}", body, start), (f"brace{k}", GROUND, hinge)]
            continue
        if kind == "arm":
            arm, hinge = f"arm{k}", point_from(start)
            new_body(arm)
            made.frames[arm] = (point_from(hinge), float(numbers.uniform(-7, 7)))
            made.pins.append((arm, GROUND, hinge))
            made.sliders.append(("pin", arm, body, start, (start - hinge) / abs(start - hinge)))
            outputs = [(arm, point_from(hinge))]  # so that the next one hangs on the arm
            continue
        while True:
            middle = point_from(start)
            hinge = point_from(middle)
            is_guided = kind in ("block", "pin")
            along = np.exp(1j * numbers.uniform(0, 2 * math.pi)) if is_guided else 1j * (hinge - middle)
            reach = abs((np.conj(along) * (middle - start)).real) / abs(along) / abs(middle - start)
            if reach > 0.3:
                break
        link, path = f"link{k}", point_from(start)
        bars = [(start, middle)]
        if k % 2 == 0:  # bent: the path point hangs on one of its ends
            bars.append((start, path) if numbers.random() < 0.5 else (path, start))
            outputs.append((link, path))
        new_body(link, *bars)
        made.pins.append((link, body, start))
        if not is_guided:
            rocker = f"rocker{k}"
            new_body(rocker, *([(middle, hinge)] if kind == "dyad" else []))
            made.pins += [(link, rocker, middle), (rocker, GROUND, hinge)]
            outputs.append((rocker, middle))
        elif kind == "block":
            slider = f"slider{k}"
            new_body(slider)
            made.frames[slider] = (middle, float(numbers.uniform(-7, 7)))
            made.pins.append((slider, link, middle))
            made.sliders.append(("block", GROUND, slider, middle, along))
        else:
            made.sliders.append(("pin", GROUND, link, middle, along))
    return made


def random_sections(numbers, count):
    sections = []
    for _ in range(count):
        width, depth = numbers.uniform(0.01, 0.05, size=2)
        sections.append((Section.rectangle(width, depth), numbers.uniform(70e9, 210e9)))
    return sections
