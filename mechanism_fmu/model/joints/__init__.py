"""What joints are; how they are enforced is in `mechanism_fmu.engine.constraints.joints`.

Each says the five steps of the ME451 slides itself: what it allows, its rows Phi, their Jacobian Phi_q, nu = -Phi_t and
gamma = -(Phi_q q')_q q' - 2 Phi_qt q' - Phi_tt, so that Phi_q q' = nu and Phi_q q'' = gamma. All of them write

- r = (x, y) and phi for the coordinates of a body: its centre of mass [m] and its angle [rad], counter-clockwise
  positive, which counts turns; ' for the derivative with respect to time (of a profile rho, with respect to alpha);
- s for a point in the frame of its body, whose axes turn with the body about the centre of mass; the frame of `GROUND`
  is the global one. A = [[cos phi, -sin phi], [sin phi, cos phi]] turns a vector of the body into the global frame, and
  R = [[0, -1], [1, 0]] turns one by +90 deg: r^P = r + A s, a = A_i s_i, b = A_j s_j;
- d = r_j^P - r_i^P, from body i to body j;
- Phi_q as [x_i, y_i, phi_i, x_j, y_j, phi_j], and behind these the contact coordinates alpha; a vector stands for two
  columns, or, in front of two rows, for two rows;
- under Outputs, the forces and torques that an `Output` can have as its source "<name>.<output>": on which body, and in
  which direction positive. They are multipliers lambda, with M q'' = F + Phi_q^T lambda, times a factor (`efforts`).
"""

from .cams import CamFlatFollower as CamFlatFollower, CamFollower as CamFollower, PointFollower as PointFollower
from .drivers import (
    AngleDriver as AngleDriver,
    DistanceDriver as DistanceDriver,
    TranslationalDriver as TranslationalDriver,
    XDriver as XDriver,
    YDriver as YDriver,
)
from .gears import Gears as Gears, InternalGears as InternalGears, RackAndPinion as RackAndPinion
from .pins_and_slides import (
    Distance as Distance,
    Revolute as Revolute,
    RevoluteTranslational as RevoluteTranslational,
    Translational as Translational,
)

#: Any driver.
Driver = XDriver | YDriver | AngleDriver | DistanceDriver | TranslationalDriver

#: Any joint.
Joint = (
    Revolute
    | Translational
    | Distance
    | RevoluteTranslational
    | Gears
    | InternalGears
    | RackAndPinion
    | XDriver
    | YDriver
    | AngleDriver
    | DistanceDriver
    | TranslationalDriver
)

#: Any higher pair: a joint by the textbook, and a contact that may open.
HigherPair = CamFollower | CamFlatFollower | PointFollower
