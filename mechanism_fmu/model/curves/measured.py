"""Measured points of a curve: how far they scatter, whether the curvature through them is noise, smoothing splines."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import MechanismError
from ..functions import Number, is_plain
from .pieces import Curve, Piece, Smoothing, Term, spline_widths

_Numbers = np.ndarray[Any, np.dtype[np.float64]]

#: Fewer points than these say nothing of noise: the ringing of a spline behind a corner reaches all of them.
_FEWEST = 30
#: Second derivatives through noise go up and down by turns at 83 of 100 points (measured; white noise of their own at
#: 73), those of smooth shapes at less than 50, but for ringing.
_BY_TURNS = 0.65
#: Their swing, as a share of the trend, from which it counts: peaks are three times as high, and half of these is what
#: the speed is off at which a follower jumps.
_SHARE = 0.02
#: Noise of 1 swings the second derivative by 7.5 over the squared distance of points (cubic; 5th degree: 17). Beyond
#: this, something else swings it, such as the ringing of a spline behind a corner.
_MOST_BY_NOISE = 100.0
#: Floats are rounded to 1.1e-16 of them, and so scatter values that were calculated.
_ROUNDING = 1e-15
#: Points on either side that the trend is the mean of.
_HALF_WINDOW = 4
#: Of a normal distribution: the median of the magnitude, in standard deviations.
_MEDIAN = 0.6745
#: Given noise that differs by more from what the points show is worth a word: the estimate is good to a quarter.
_MISJUDGED = 2.0


def smooth_periodic(knots: Sequence[float], values: Sequence[Number], degree: int, noise: float) -> Curve:
    """The periodic smoothing spline with the fewest knots whose residuals have the standard deviation `noise`.

    Args:
        knots: places of the points, which increase; the last one is where the first value comes again.
        values: at the points, plain numbers.
        degree: 3 or 5.
        noise: standard deviation of the values [their unit], > 0.

    Raises:
        MechanismError: scipy is missing, the noise is no positive number, values depend on parameters, or no spline is
            found.

    Source: P. Dierckx, Curve and Surface Fitting with Splines, chapter 6: `percur` of FITPACK, by scipy's `splrep`.
    """
    spline_widths(knots, len(values), degree, periodic=True)
    if not all(map(is_plain, values)):
        raise MechanismError(
            "A smoothing spline needs plain numbers as values, because its knots depend on them, but one depends on a "
            "parameter. Smooth the measured numbers, or leave the noise out."
        )
    if not (is_plain(noise) and 0.0 < float(noise) < np.inf):
        raise MechanismError(
            f"The noise of a spline's points is {noise}; give its standard deviation, above 0, e.g. '1 um'."
        )
    if len(values) <= degree:
        raise MechanismError(
            f"A smoothing spline of degree {degree} needs more than {degree} points, but there are {len(values)}."
        )
    try:
        # Takes long to load; and an FMU by pythonfmu asks for it only where a curve is smoothed (`fmu.package`).
        scipy_splines = importlib.import_module("scipy.interpolate")
    except ImportError as error:
        raise MechanismError(
            "A profile with noise is smoothed by scipy, which is not installed: "
            'python -m pip install "mechanism_fmu[analysis]"; or leave the noise out.'
        ) from error
    places, points = np.asarray(knots, dtype=float), np.asarray([*values, values[0]], dtype=float)
    count = len(values)
    spline, _, failure, message = scipy_splines.splrep(
        places, points, np.full(count + 1, 1.0 / noise), k=degree, s=count, per=True, full_output=True, quiet=True
    )
    if failure > 0:
        raise MechanismError(
            f"No smoothing spline of degree {degree} goes through {count} points with noise of {noise:g}: "
            f"{' '.join(str(message).split())} Give more noise, or none."
        )
    polynomials = scipy_splines.PPoly.from_spline(spline)
    inside = (polynomials.x[:-1] >= places[0]) & (polynomials.x[:-1] < places[-1]) & (np.diff(polynomials.x) > 0.0)
    pieces = tuple(
        Piece(float(start), (Term(tuple(map(float, row[::-1]))),))
        for start, row in zip(polynomials.x[:-1][inside], polynomials.c.T[inside], strict=True)
    )
    off = points[:-1] - scipy_splines.splev(places[:-1], spline)
    through = scipy_splines.make_interp_spline(places, points, k=degree, bc_type="periodic")
    change = through(places[:-1], 2) - scipy_splines.splev(places[:-1], spline, der=2)
    smoothing = Smoothing(
        noise=float(noise),
        scatter=scatter_of(places, points),
        points=count,
        pieces=len(pieces),
        degree=degree,
        rms=float(np.sqrt(np.mean(off**2))),
        largest=float(np.abs(off).max()),
        second_derivative_change=float(np.abs(change).max()),
    )
    return Curve(pieces, float(places[0]), float(places[-1] - places[0]), periodic=True, smoothing=smoothing)


def remark_on(curve: Curve) -> str | None:
    """A remark on a curve whose second derivative is noise, or that is smoothed with another noise than there is."""
    if curve.smoothing is not None:
        noise, scatter = curve.smoothing.noise, curve.smoothing.scatter
        if scatter > 0.0 and max(noise / scatter, scatter / noise) > _MISJUDGED:
            return (
                f"is smoothed with noise of {noise:.3g}, but its points scatter by about {scatter:.2g}: with less "
                f"noise than there is, the curvature keeps it; with more, the shape is lost. {curve.smoothing}"
            )
        return None
    polynomial = all(is_plain(t.amplitude) and t.amplitude == 0.0 for p in curve.pieces for t in p.terms)
    if len(curve.pieces) < _FEWEST or not polynomial or not _is_plain_curve(curve):
        return None
    places, values, second = _starts(curve)
    if not np.all(np.diff(places) > 0.0):
        return None
    bends = np.append(second, second[:2]) if curve.periodic else second
    off = bends[1:-1] - 0.5 * (bends[:-2] + bends[2:])
    by_turns = float(np.mean(off[:-1] * off[1:] < 0.0))
    swing = float(np.median(np.abs(off)))
    window = np.full(2 * _HALF_WINDOW + 1, 1.0 / (2 * _HALF_WINDOW + 1))
    trend = float(np.abs(np.convolve(bends, window, "valid")).max())
    if curve.periodic:
        places, values = np.append(places, places[0] + float(curve.span)), np.append(values, values[0])
    scatter = scatter_of(places, values)
    by_noise = _MOST_BY_NOISE * scatter / float(np.median(np.diff(places))) ** 2
    by_rounding = scatter <= _ROUNDING * float(np.abs(values).max())
    if by_rounding or not (by_turns > _BY_TURNS and _SHARE * trend < swing < by_noise):
        return None
    return (
        f"has {len(curve.pieces)} points whose second derivative is noise: from point to point it goes up and down by "
        f"{swing:.3g}, where its trend is {trend:.3g} at most, and so do the forces of what follows it. The points "
        f"scatter by about {scatter:.2g} about a smooth curve: smooth a profile with spline_profile(..., degree=5, "
        f"noise={scatter:.1g}), or give points with more digits."
    )


def scatter_of(places: _Numbers, values: _Numbers) -> float:
    """Standard deviation of points about a smooth curve: each beside the cubic through its four neighbours."""
    off = []
    for k in range(2, len(places) - 2):
        around = [k - 2, k - 1, k + 1, k + 2]
        x = places[around] - places[k]
        weights = np.array([np.prod([x[m] / (x[m] - x[j]) for m in range(4) if m != j]) for j in range(4)])
        off.append(abs(values[k] - weights @ values[around]) / np.sqrt(1.0 + weights @ weights))
    return float(np.median(off)) / _MEDIAN if off else 0.0


def _is_plain_curve(curve: Curve) -> bool:
    numbers = [c for piece in curve.pieces for term in piece.terms for c in (piece.start, *term.polynomial)]
    return all(map(is_plain, [*numbers, curve.span]))


def _starts(curve: Curve) -> tuple[_Numbers, _Numbers, _Numbers]:
    """Place, value and second derivative where each piece of polynomials begins."""
    rows = [
        (
            float(piece.start),
            sum(float(t.polynomial[0]) for t in piece.terms if t.polynomial),
            sum(2.0 * float(t.polynomial[2]) for t in piece.terms if len(t.polynomial) > 2),
        )
        for piece in curve.pieces
    ]
    places, values, second = np.array(rows).T
    return places, values, second
