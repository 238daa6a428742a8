"""Laws of a planar impact at one point, in closed form, for many impacts at once.

A law takes the velocities of the contact before the impact and what impulses do to them, v+ - v- = G P, and gives the
impulse P = (P_N, P_T). It has two numbers: the coefficient of friction mu and a coefficient of restitution e. Three of
them are those of the engine (docs/explanation/friction.md); they are written here a second time, because the harness
does not import the engine, and for whole tables: tests/analytic/test_impact_laws.py compares the two.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
#: Normal and tangential impulse, of unit mass where G is [m/s].
Impulse = tuple[Array, Array]

#: In a phase the slip changes at most once; a part more does no harm.
_PARTS = 3


class Contact(NamedTuple):
    """Points that strike, one an entry; all arrays of one shape, or of shapes that broadcast.

    Attributes:
        g_nn, g_nt, g_tt: change of the contact's velocity by impulses, G = J M^-1 J^T, of unit mass [1].
        v_n: velocity along the normal before the impact [m/s], negative: it approaches.
        v_t: slip before it [m/s].
    """

    g_nn: Array
    g_nt: Array
    g_tt: Array
    v_n: Array
    v_t: Array


# Newton and Poisson: complementarity.


def newton(contact: Contact, mu: Array, e: Array, e_t: Array | float = 0.0) -> Impulse:
    """Newton's law with Coulomb's friction as one problem: 0 <= v_N+ + e v_N- _|_ P_N >= 0, -P_T in mu P_N Sgn(v_T+).

    It may add energy (Kane, Levinson 1985), and have no answer where mu is large: then Poisson's law is taken, as in
    the engine. Where it has several answers, the one that sticks is taken.

    Args:
        contact: what strikes.
        mu: coefficient of friction [1].
        e: coefficient of restitution [1].
        e_t: of restitution along the tangent [1], Sgn(v_T+ + e_t v_T-) in place of Sgn(v_T+).

    Source: Moreau 1988; Glocker, Pfeiffer, Nonlinear Dynamics 7 (1995) 471; e_t: Pfeiffer, Glocker 1996.
    """
    normal, tangential, found = _at_rest(contact, (1.0 + e) * contact.v_n, (1.0 + e_t) * contact.v_t, mu)
    if bool(np.all(found)):
        return normal, tangential
    instead = poisson(contact, mu, e)
    return np.where(found, normal, instead[0]), np.where(found, tangential, instead[1])


def poisson(contact: Contact, mu: Array, e: Array) -> Impulse:
    """Poisson's law in two phases: compression with e = 0, expansion with at least e times the impulse of that.

    Args:
        contact: what strikes.
        mu: coefficient of friction [1], in each phase.
        e: coefficient of restitution [1].

    Source: Glocker, Pfeiffer, Nonlinear Dynamics 7 (1995) 471; Anitescu, Potra, Nonlinear Dynamics 14 (1997) 231.
    """
    g_nn, g_nt, g_tt, v_n, v_t = contact
    normal, tangential, _ = _at_rest(contact, v_n, v_t, mu)
    v_n = v_n + g_nn * normal + g_nt * tangential
    v_t = v_t + g_nt * normal + g_tt * tangential
    given = e * normal
    along = np.clip(-(v_t + g_nt * given) / g_tt, -mu * given, mu * given)
    # friction alone would press it in again: then the expansion gives more than it must
    more_normal, more_along, found = _at_rest(contact, v_n, v_t, mu)
    needs_more = (v_n + g_nn * given + g_nt * along < 0.0) & found & (more_normal > given)
    return (
        normal + np.where(needs_more, more_normal, given),
        tangential + np.where(needs_more, more_along, along),
    )


def _at_rest(contact: Contact, u_n: Array, u_t: Array, mu: Array) -> tuple[Array, Array, npt.NDArray[np.bool_]]:
    """Impulse that brings u_n to zero, with Coulomb's friction on u_t; and where there is one with P_N >= 0."""
    g_nn, g_nt, g_tt = contact.g_nn, contact.g_nt, contact.g_tt
    determinant = g_nn * g_tt - g_nt * g_nt
    normal = (g_nt * u_t - g_tt * u_n) / determinant
    tangential = (g_nt * u_n - g_nn * u_t) / determinant
    found = np.abs(tangential) <= mu * normal
    for sign in (1.0, -1.0):
        slope = g_nn - sign * mu * g_nt
        slips = -u_n / np.where(slope > 0.0, slope, np.inf)
        takes = ~found & (slope > 0.0) & (slips >= 0.0)
        takes &= sign * (u_t + (g_nt - sign * mu * g_tt) * slips) >= 0.0
        normal = np.where(takes, slips, normal)
        tangential = np.where(takes, -sign * mu * slips, tangential)
        found = found | takes
    return normal, tangential, found


# Stronge, Wang and Mason: Routh's path.


class _Path(NamedTuple):
    """A point of Routh's path: impulses so far, the velocities there, the work of P_N in the present phase."""

    normal: Array
    tangential: Array
    v_n: Array
    v_t: Array
    work: Array


def stronge(contact: Contact, mu: Array, e: Array) -> Impulse:
    """Stronge's law: the work of P_N in expansion is e^2 times that of compression, along Routh's path.

    It never adds energy for e <= 1. Arguments as of `poisson`.

    Source: Stronge, Impact Mechanics, Cambridge 2000; Routh 1905.
    """
    begins = _compressed(contact, mu)
    target = -e * e * begins.work

    def left(path: _Path, slope: Array) -> Array:
        root = np.sqrt(np.maximum(0.0, path.v_n * path.v_n + 2.0 * slope * (target - path.work)))
        return (root - path.v_n) / slope

    end = _along(contact, mu, begins._replace(work=np.zeros_like(target)), left)
    return end.normal, end.tangential


def wang_mason(contact: Contact, mu: Array, e: Array) -> Impulse:
    """Poisson's e on Routh's path: P_N at the end is 1 + e times that of compression. Arguments as of `poisson`.

    Source: Wang, Mason, Journal of Applied Mechanics 59 (1992) 635; Routh 1905.
    """
    begins = _compressed(contact, mu)
    target = (1.0 + e) * begins.normal
    end = _along(contact, mu, begins, lambda path, _: target - path.normal)
    return end.normal, end.tangential


def _compressed(contact: Contact, mu: Array) -> _Path:
    """The path up to v_N = 0."""
    zero = np.zeros(np.broadcast_shapes(np.shape(contact.v_n), np.shape(mu)))
    path = _Path(zero, zero, contact.v_n + zero, contact.v_t + zero, zero)
    path = _along(contact, mu, path, lambda path, slope: -path.v_n / slope)
    return path._replace(v_n=zero)


def _along(contact: Contact, mu: Array, path: _Path, left: Callable[[_Path, Array], Array]) -> _Path:
    """Go on along the path to where its phase ends; `left` is the P_N to there if it is straight, by dv_N/dP_N."""
    g_nn, g_nt, g_tt = contact.g_nn, contact.g_nt, contact.g_tt
    done: npt.NDArray[np.bool_] = np.zeros(np.shape(path.v_n), dtype=bool)
    for _ in range(_PARTS):
        # where slip has ended, it goes on if the friction that would hold it is out of the cone
        goes = np.where(path.v_t != 0.0, np.sign(path.v_t), np.where(np.abs(g_nt) > mu * g_tt, np.sign(g_nt), 0.0))
        ratio = np.where(goes == 0.0, -g_nt / g_tt, -goes * mu)  # dP_T / dP_N
        slope_n = g_nn + ratio * g_nt
        slope_t = np.where(goes == 0.0, 0.0, g_nt + ratio * g_tt)
        ends_slip = goes * slope_t < 0.0
        to_stick = np.where(ends_slip, -path.v_t / np.where(ends_slip, slope_t, 1.0), np.inf)
        opens = slope_n > 0.0
        to_end = np.where(opens, left(path, np.where(opens, slope_n, 1.0)), np.inf)
        part = np.where(done, 0.0, np.maximum(0.0, np.minimum(to_end, to_stick)))
        sticks = ~done & (to_stick < to_end)
        path = _Path(
            path.normal + part,
            path.tangential + ratio * part,
            path.v_n + slope_n * part,
            np.where(sticks, 0.0, path.v_t + slope_t * part),
            path.work + part * (path.v_n + 0.5 * slope_n * part),
        )
        done = done | ~sticks
    return path


# What can be fitted.


@dataclass(frozen=True)
class Law:
    """A law and its numbers.

    Attributes:
        name: in files.
        label: in tables.
        impulse: by what strikes and the numbers [1]: mu, e, and e_t where there are three.
        engine: its name as `Mechanism.impact_law`; "" where the engine does not have it.
        numbers: how many it has.
    """

    name: str
    label: str
    impulse: Callable[..., Impulse]
    engine: str = ""
    numbers: int = 2


LAWS = (
    Law("newton", "Newton", newton, "newton"),
    Law("poisson", "Poisson", poisson, "poisson"),
    Law("stronge", "Stronge", stronge, "stronge"),
    Law("wang_mason", "Wang-Mason", wang_mason),
    Law("newton_tangential", "Newton with e_t", newton, numbers=3),
)
