"""Profiles of cams and slots: the radius rho [m] over the contact coordinate alpha [rad], counter-clockwise.

A point of the profile is Q + rho(alpha) (cos alpha, sin alpha) in the frame of its body (ME451, cam pairs).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..functions import Number
from ..quantities import quantity
from .measured import smooth_periodic
from .motions import Law, Move, cycloidal, moves_to_pieces
from .pieces import Curve, Piece, Term, constant, cosine, plain_places, sine, spline_pieces

_TURN = 2 * math.pi


def circle(radius: Number) -> Curve:
    """A circle of a radius [m] about Q: a roller.

    Args:
        radius: [m], > 0.

    Source: definition: rho = radius, of boundaries in polar coordinates as in the ME451 slides on cams.
    """
    return _closed((Piece(0.0, (constant(radius),)),))


def harmonic_profile(mean: Number, cosines: Sequence[Number] = (), sines: Sequence[Number] = ()) -> Curve:
    """Radius rho = mean + sum over k = 1, 2 ... of cosines[k-1] cos(k alpha) + sines[k-1] sin(k alpha) [m].

    Args:
        mean: of the radius [m].
        cosines: amplitudes [m] of the harmonics 1, 2, ...
        sines: amplitudes [m] of the harmonics 1, 2, ...

    Source: definition: a Fourier series that ends, of boundaries in polar coordinates as in the ME451 slides on cams.
    """
    terms = [constant(mean)]
    terms += [cosine(a, float(k)) for k, a in enumerate(cosines, start=1)]
    terms += [sine(b, float(k)) for k, b in enumerate(sines, start=1)]
    return _closed((Piece(0.0, tuple(terms)),))


def piecewise_profile(*pieces: tuple[Number, Sequence[Term]]) -> Curve:
    """A closed profile of analytic pieces: (alpha where it starts [rad], its terms [m]), the first from 0 on.

    Args:
        pieces: pairs of the angle where each starts [rad] and its terms [m].

    Source: definition: one piece behind the other, of boundaries in polar coordinates as in the ME451 slides on cams.
    """
    return _closed(tuple(Piece(start, tuple(terms)) for start, terms in pieces))


def spline_profile(
    radii: Sequence[Number],
    angles: Sequence[float] | None = None,
    degree: int | None = None,
    noise: float | str | None = None,
) -> Curve:
    """A closed profile through points, or within their noise: the periodic spline of third degree (C2) or fifth (C4).

    Args:
        radii: [m].
        angles: increasing, within one turn [rad]; equidistant from 0 on when left out.
        degree: 3 or 5; when left out 3, and 5 with noise.
        noise: standard deviation of measured radii about the true profile [m], or with its unit, e.g. "1 um"; the
            spline is then a smoothing one, and its `smoothing` says what it assumes. Radii must be plain numbers, and
            scipy be installed.

    Raises:
        MechanismError: fewer than 3 points, another count of angles or degree, or angles that do not increase or that
            depend on a parameter; with noise, scipy is missing, radii depend on parameters, or no spline is found.

    Source: C. de Boor, A Practical Guide to Splines: the interpolating spline, periodic; each piece by the Hermite
        polynomial of its ends, and what is unknown there from continuous higher derivatives. With noise: P. Dierckx,
        Curve and Surface Fitting with Splines, FITPACK's `percur` by scipy.
    """
    count = len(radii)
    places = [_TURN * k / count for k in range(count)] if angles is None else plain_places(angles, "angle")
    knots = [*places, places[0] + _TURN] if places else [0.0]
    if noise is not None:
        return smooth_periodic(knots, radii, 5 if degree is None else degree, quantity(noise, "m", "noise"))
    return Curve(
        spline_pieces(knots, radii, 3 if degree is None else degree, periodic=True), knots[0], _TURN, periodic=True
    )


def motion_profile(base_radius: Number, moves: Sequence[Move], back: Law = cycloidal) -> Curve:
    """A cam that lifts a point follower by standard motion laws: base_radius + lift(alpha).

    Args:
        base_radius: [m].
        moves: one after the other, from alpha = 0 and lift 0 on.
        back: the law by which what is left of the turn leads back to the base radius; after moves that end there, it
            rests.

    Raises:
        MechanismError: a move's width is negative, or the moves need more than a turn.

    Source: textbook: R. L. Norton, Cam Design and Manufacturing Handbook, radial cams: base radius plus lift, each rise
        by its law of motion.
    """
    return _closed(moves_to_pieces(base_radius, moves, _TURN, back))


def slot(points: Sequence[tuple[float, Number]], degree: int = 3) -> Curve:
    """An open profile through points (alpha [rad], rho [m]): a spline, rho' (of degree 5, and rho'') 0 at its ends.

    Args:
        points: pairs of alpha [rad] and radius [m], at least 3, their alpha plain numbers that increase.
        degree: of the spline, 3 (C2) or 5 (C4).

    Raises:
        MechanismError: fewer than 3 points, another degree, or angles that do not increase or that depend on a
            parameter.

    Source: C. de Boor, A Practical Guide to Splines: the interpolating spline with clamped ends; pieces as of
        `spline_profile`.
    """
    angles, radii = plain_places([angle for angle, _ in points], "angle"), [radius for _, radius in points]
    pieces = spline_pieces(angles, radii, degree, periodic=False)
    return Curve(pieces, angles[0], angles[-1] - angles[0])


def _closed(pieces: tuple[Piece, ...]) -> Curve:
    return Curve(pieces, 0.0, _TURN, periodic=True)
