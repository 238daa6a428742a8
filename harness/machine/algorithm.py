"""Algorithms by name."""

from __future__ import annotations

from .algorithms.adaptive import Adaptive
from .algorithms.base import Algorithm
from .algorithms.event_aware import EventAware
from .algorithms.gauss_seidel import GaussSeidel
from .algorithms.jacobi import Jacobi
from .file.plan import Policy, Scheme
from .machine import Machine


def algorithm_of(policy: Policy, machine: Machine) -> Algorithm:
    """The algorithm that a plan asks for.

    Raises:
        UsageError: the machine cannot be stepped so.
    """
    match policy.scheme:
        case Scheme.JACOBI:
            return Jacobi()
        case Scheme.GAUSS_SEIDEL:
            return GaussSeidel()
        case Scheme.EVENT_AWARE:
            return EventAware(machine)
        case Scheme.ADAPTIVE:
            return Adaptive(machine, 1e-4 if policy.tolerance is None else policy.tolerance)
