"""From one position of a driven mechanism to the next one of the same motion."""

from __future__ import annotations

import numpy as np

from ..engine.starting.assembly import CLOSED_WITHIN
from .equations import Equations, FloatArray
from .errors import KinematicsError
from .solve import close
from .state import State, least_singular_value, state_at

#: A step is right when Phi_q changes by less than this part of its least singular value: no singular configuration can
#: lie between, nor can the step end on another branch.
_MOST_CHANGE = 0.5
#: Or when the position changes by less than this part of it: what jumps then is the curvature of a profile.
_LEAST_MOVE = 0.01
#: In one step, no angle changes by more than this [rad]: after a whole turn Phi_q is the same again.
_MOST_TURN = 0.5
#: Steps are halved at most down to this part of the way.
_SHORTEST = 1e-14


def follow(equations: Equations, here: State, time: float) -> State:
    """The state at `time` [s], later than `here`.

    Raises:
        KinematicsError: as of `state_at`, or the rows cannot be closed.
        SingularConfigurationError: the motion comes to a singular configuration on the way.
    """
    shortest = _SHORTEST * (time - here.time)
    step = time - here.time
    while here.time < time:
        target = time if here.time + step >= time else here.time + step
        h = target - here.time
        q, left = close(equations, here.q + h * here.qd + 0.5 * h * h * here.qdd, target)
        if left <= CLOSED_WITHIN and _is_same_motion(equations, here, q, target):
            here = state_at(equations, q, target)
            step *= 2.0
        elif step > shortest:
            step *= 0.5
        else:
            raise _lost(equations, here, q, target)
    return here


def _is_same_motion(equations: Equations, here: State, q: FloatArray, time: float) -> bool:
    if np.abs((q - here.q)[equations.angular]).max(initial=0.0) > _MOST_TURN:
        return False
    rows = equations.balanced(equations.at(q, time).jacobian)
    least = min(here.least, least_singular_value(rows))
    if np.linalg.norm(rows - here.jacobian, 2) <= _MOST_CHANGE * here.least:
        return True
    return float(np.linalg.norm(equations.as_lengths(q - here.q))) <= _LEAST_MOVE * least * equations.size


def _lost(equations: Equations, here: State, q: FloatArray, time: float) -> KinematicsError:
    residual = np.abs(equations.at(q, time).residual)
    worst = [equations.rows[k] for k in np.argsort(-residual)[:4] if residual[k] > CLOSED_WITHIN]
    what = f"{', '.join(worst)} stay open by {residual.max():.3g} (m, or rad)" if worst else "the next one is far away"
    return KinematicsError(
        f"Behind t = {here.time:.9g} s no position is found that goes on from there: {what}. A profile has an edge, "
        "or drivers ask for a position out of reach."
    )
