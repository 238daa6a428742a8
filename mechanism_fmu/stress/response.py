"""Free response of a mode to an impact."""

from __future__ import annotations

import math

import numpy as np

from .checks import FloatArray


def damped_response(
    natural_frequency: FloatArray, damping_ratio: float, impact_velocity: float, t: FloatArray
) -> FloatArray:
    """Modal coordinates eta_i(t) [m] after an impact at t = 0, of shape (number of modes, len(t)).

    Each solves m eta'' + c eta' + k eta = 0 with c = 2 zeta sqrt(k m), eta(0) = 0 and eta'(0) = v_I:
    eta = v_I / Lambda_d exp(-zeta Lambda t) sin(Lambda_d t), where Lambda_d = Lambda sqrt(1 - zeta^2).

    Args:
        natural_frequency: Lambda_i = sqrt(k_i / m_i) [rad/s], of shape (number of modes,).
        damping_ratio: zeta [-], 0 <= zeta < 1.
        impact_velocity: v_I [m/s].
        t: times since the impact [s], of shape (n,).

    Source: Pennestrì, Valentini, Vita, eq (10) and the initial conditions below it.
    """
    damped = natural_frequency * math.sqrt(1 - damping_ratio**2)
    decay = np.exp(-damping_ratio * np.multiply.outer(natural_frequency, t))
    swing = np.sin(np.multiply.outer(damped, t))
    return np.asarray((impact_velocity / damped)[:, None] * decay * swing)
