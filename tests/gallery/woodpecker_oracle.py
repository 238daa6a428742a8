"""The woodpecker toy in three coordinates, apart from the project's engine: by hand, with an integrator of scipy.

q = (y, phi_M, phi_S): height of the sleeve, angles of sleeve and bird; one contact touches at a time. It is the toy
with its angles as they are, or linearised as in the paper, whose model is the latter. Source: Leine, Glocker, van
Campen, Nonlinear dynamics of the woodpecker toy, DETC2001/VIB-21608 (2001), eqs (6) to (10).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

SLEEVE, SLEEVE_INERTIA, BIRD, BIRD_INERTIA = 3e-4, 5e-9, 4.5e-3, 7e-7
STIFFNESS, GRAVITY, FRICTION = 0.0056, 9.81, 0.3
PIN, CENTRE, POLE = 0.010, 0.015, 0.0025
#: Point beside the pole in the frame of the sleeve (False) or of the bird from the pin (True), and restitution.
POINTS = {
    "beak": (True, (CENTRE - 0.0201, 0.020), 0.5),
    "bottom": (False, (0.0031, -0.0058), 0.0),
    "top": (False, (0.0031, 0.0058), 0.0),
}


@dataclass
class Toy:
    """The toy in motion, from rest with the sleeve jammed at the bottom.

    Attributes:
        start: angle of the bird [rad].
        law: of impacts, "newton" or "poisson".
        linear: whether angles are small, as in the paper.
        events: time [s], name, of what has happened; impacts also with their closing speed [m/s].
    """

    start: float
    law: str
    linear: bool
    time: float = 0.0
    events: list[tuple[float, str, float]] = field(default_factory=list)

    def _turn(self, angle: float) -> tuple[float, float]:
        return (1.0, angle) if self.linear else (math.cos(angle), math.sin(angle))

    def _arm(self, point: tuple[float, float], angle: float) -> tuple[float, float]:
        """A vector of a body in space; small angles leave its products with themselves alone."""
        c, s = self._turn(angle)
        return c * point[0] - s * point[1], s * point[0] + c * point[1]

    def gap(self, name: str, q: np.ndarray) -> float:
        of_bird, point, _ = POINTS[name]
        if of_bird:
            return self._arm((PIN, 0.0), q[1])[0] + self._arm(point, q[2])[0] - POLE
        return self._arm(point, q[1])[0] - POLE

    def rows(self, name: str, q: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Normal and tangential row, and what their rates have beside them: 2 by 3, 2."""
        of_bird, point, _ = POINTS[name]
        arms = [(PIN, 0.0), point] if of_bird else [point]
        rows, beside = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), np.zeros(2)
        for k, arm in enumerate(arms, start=1):
            x, y = arm if self.linear else self._arm(arm, q[k])
            rows[:, k] = -y, x
            beside -= 0.0 if self.linear else np.array([x, y]) * u[k] ** 2
        return rows, beside

    def masses(self, q: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mass matrix and forces."""
        centre, beside = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), np.zeros(2)
        for k, length in ((1, PIN), (2, CENTRE)):
            x, y = (length, 0.0) if self.linear else self._arm((length, 0.0), q[k])
            centre[:, k] = -y, x
            beside -= 0.0 if self.linear else np.array([x, y]) * u[k] ** 2
        mass = np.diag([SLEEVE, SLEEVE_INERTIA, BIRD_INERTIA]) + BIRD * centre.T @ centre
        twist = STIFFNESS * (q[2] - q[1])
        force = np.array([-SLEEVE * GRAVITY, twist, -twist])
        return mass, force - BIRD * centre.T @ (beside + np.array([0.0, GRAVITY]))

    def solve(self, mode: tuple[str, str] | None, q: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Accelerations, and the forces normal and tangential, in a mode: contact and "stick", "+" or "-"."""
        mass, force = self.masses(q, u)
        if mode is None:
            return np.linalg.solve(mass, force), np.zeros(2)
        rows, beside = self.rows(mode[0], q, u)
        free = rows @ np.linalg.solve(mass, force) + beside
        g = rows @ np.linalg.solve(mass, rows.T)
        if mode[1] == "stick":
            contact = -np.linalg.solve(g, free)
        else:
            slope = -FRICTION if mode[1] == "+" else FRICTION
            contact = -free[0] / (g[0, 0] + slope * g[0, 1]) * np.array([1.0, slope])
        return np.linalg.solve(mass, force + rows.T @ contact), contact

    def impulse(self, name: str, q: np.ndarray, u: np.ndarray) -> np.ndarray:
        """The rates after an impact."""
        rows, _ = self.rows(name, q, u)
        inverse = np.linalg.solve(self.masses(q, u)[0], rows.T)
        g, v, e = rows @ inverse, rows @ u, POINTS[name][2]
        impulse = _phase(g, v, None, -(1.0 + (e if self.law == "newton" else 0.0)) * v[0])
        if self.law == "poisson" and e > 0.0:
            impulse = impulse + _phase(g, v + g @ impulse, e * impulse[0], 0.0)
        return u + inverse @ impulse

    def cycle(self) -> tuple[float, float, float]:
        """Until the bird stands still again with the sleeve jammed: time [s], its angle [rad], the fall [m]."""
        jam = brentq(lambda angle: self.gap("bottom", np.array([0.0, angle, 0.0])), -0.15, -0.05, xtol=1e-16)
        state, mode = np.array([0.0, jam, self.start, 0.0, 0.0, 0.0]), ("bottom", "stick")
        while True:
            names, guards = zip(*self._guards(mode), strict=True)
            out = solve_ivp(
                lambda _t, s, now=mode: np.concatenate((s[3:], self.solve(now, s[:3], s[3:])[0])),
                (self.time, self.time + 1.0), state, "DOP853", events=guards, rtol=1e-12, atol=1e-14, max_step=2e-3,
            )  # fmt: skip
            which = next(k for k, times in enumerate(out.t_events) if len(times))
            self.time, state = out.t_events[which][0], out.y_events[which][0]
            if names[which] == "still":
                return self.time, state[2], state[0]
            state, mode = self._after(names[which], mode, state)

    def _guards(self, mode):
        """Names and functions whose zero from above ends a mode."""
        found = [(f"{n}.gap", lambda _t, s, n=n: self.gap(n, s[:3])) for n in POINTS if mode is None or n != mode[0]]
        if mode is not None:
            found.append((f"{mode[0]}.force", lambda _t, s: self.solve(mode, s[:3], s[3:])[1][0]))
        if mode is not None and mode[1] == "stick":
            found.append((f"{mode[0]}.slips", lambda _t, s: self._margin(mode, s)))
            if any(name == "beak.gap" for _, name, _ in self.events):
                found.append(("still", lambda _t, s: -s[5]))
        elif mode is not None:
            sign = 1.0 if mode[1] == "+" else -1.0
            found.append((f"{mode[0]}.sticks", lambda _t, s: sign * (self.rows(mode[0], s[:3], s[3:])[0][1] @ s[3:])))
        for _, guard in found:
            guard.terminal, guard.direction = True, -1.0
        return found

    def _margin(self, mode, state) -> float:
        _, force = self.solve(mode, state[:3], state[3:])
        return FRICTION * force[0] - abs(force[1])

    def _after(self, name, mode, state):
        """State and mode after an event."""
        part, what = name.split(".")
        q, u, speed = state[:3], state[3:], 0.0
        if what == "gap":
            assert mode is None
            speed = -float(self.rows(part, q, u)[0][0] @ u)
            u = self.impulse(part, q, u)
            state = np.concatenate((q, u))
        self.events.append((self.time, name, speed))
        normal, tangential = self.rows(part, q, u)[0] @ u
        if what == "force" or normal > 1e-9:
            mode = None
        elif abs(tangential) < 1e-9:
            mode = (part, "stick")
            if what == "slips" or self._margin(mode, state) < 0.0:
                mode = (part, "-" if self.solve(mode, q, u)[1][1] > 0.0 else "+")
        else:
            mode = (part, "+" if tangential > 0.0 else "-")
        if mode is not None and self.solve(mode, q, u)[1][0] < 0.0:
            mode = None
        return state, mode


def _phase(g: np.ndarray, v: np.ndarray, normal: float | None, rise: float) -> np.ndarray:
    """Impulses that raise the normal speed by `rise`, or with a given normal impulse; Coulomb along the tangent."""
    if normal is None:
        stick = np.linalg.solve(g, [rise, -v[1]])
    else:
        stick = np.array([normal, -(v[1] + g[1, 0] * normal) / g[1, 1]])
    if abs(stick[1]) <= FRICTION * stick[0]:
        return stick
    for slope in (-FRICTION, FRICTION):
        size = rise / (g[0, 0] + slope * g[0, 1]) if normal is None else normal
        if size >= 0.0 and slope * (v[1] + g[1] @ (size * np.array([1.0, slope]))) <= 0.0:
            return size * np.array([1.0, slope])
    raise AssertionError("no impulse agrees with friction")
