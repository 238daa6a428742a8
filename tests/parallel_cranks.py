"""Equal cranks that carry a coupler without turning it: n cranks have 3 (n + 1) coordinates and rank 3 n + 2."""

import math

from mechanism_fmu.model import GROUND, AngleDriver, Body, Mechanism, Revolute
from mechanism_fmu.model.curves.motions import polynomial_motion

ARM = 0.5


def parallel_cranks(count, angle=0.4, hinges=None, size=1.0):
    """`count` cranks of length size/2 with centres in their middle; hinges one behind the other on x when left out."""
    arm = ARM * size
    c, s = arm * math.cos(angle), arm * math.sin(angle)
    hinges = [(size * x, size * y) for x, y in (hinges or [(float(k), 0.0) for k in range(count)])]
    bodies, joints = [], []
    for k, (x, y) in enumerate(hinges):
        name = f"crank{k}"
        bodies.append(Body(name, 0.3, 0.02, (x + c / 2, y + s / 2, angle)))
        joints += [
            Revolute(f"{name}_hinge", name, (-arm / 2, 0.0), GROUND, (x, y)),
            Revolute(f"{name}_pin", name, (arm / 2, 0.0), "coupler", (x, y)),
        ]
    return Mechanism(bodies=(*bodies, Body("coupler", 1.2, 1.0, (c, s, 0.0))), joints=tuple(joints))


def turning(name, body, *coefficients):
    """A driver that turns a body as a polynomial of time says."""
    return AngleDriver(name, body, polynomial_motion(*coefficients))
