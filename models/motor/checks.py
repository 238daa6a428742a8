"""What is wrong with parameter values that are each within their limits."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import Finding

#: An armature or a controller that is so fast [s] costs millions of steps a second and shows nothing.
FASTEST = 1e-6


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the motor cannot be run: value, limit and way out."""
    electrical = values.inductance / values.resistance
    rate = values.anti_windup * values.integral_gain
    return (
        Finding(
            FASTEST - electrical,
            "The armature's time constant inductance / resistance = {:.3g} s is shorter than "
            f"{FASTEST:g} s, and steps would be as small. Give a larger inductance = {{:.3g}} H: as long as the time "
            "constant stays far below the rotor's, it changes little.",
            (electrical, values.inductance),
        ),
        Finding(
            rate * FASTEST - 1.0,
            "anti_windup * integral_gain = {:.3g} 1/s is more than "
            f"{1 / FASTEST:g} 1/s, and steps would be too small. Give a smaller anti_windup.",
            (rate,),
        ),
    )
