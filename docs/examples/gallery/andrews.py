"""Andrews' squeezing mechanism: seven bodies without gravity, driven by a constant torque and held by a spring.

It starts at rest with the crank K1 and the rod K2 in line; everything else follows from lengths. Frames of bars point
to their second end, so that angles differ from those of the sources by quarter turns. Sources: W. Schiehlen (ed.),
Multibody Systems Handbook, 1990; Hairer and Wanner, Solving Ordinary Differential Equations II; Test
Set for IVP Solvers, which has the values at t = 0.03 s.
"""

from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    Model,
    Output,
    Revolute,
    SpringDamper,
    Torque,
    bar,
    dyad,
    settings_parameters,
    torque_parameter,
    toward,
)

ORIGIN, A, B, C = (0.0, 0.0), (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)


def mechanism(values):
    """The squeezer: F joins four bodies."""
    f = dyad(ORIGIN, B, from_a=0.021, from_b=0.035)
    e, h = (dyad(A, f, from_a=0.04, from_b=0.02, side=side) for side in ("left", "right"))
    p = toward(ORIGIN, f, -0.007)
    k1 = bar("K1", ORIGIN, p, mass=0.04325, inertia=2.194e-6, centre=(0.00092, 0))
    k2 = bar("K2", p, f, mass=0.00365, inertia=4.41e-7, centre=(0.0115, 0))
    k3 = bar("K3", B, f, mass=0.02373, inertia=5.255e-6, centre=(0.01874, 0.01043))
    k4 = bar("K4", f, e, mass=0.00706, inertia=5.667e-7, centre=(0.01421, 0))
    k5 = bar("K5", A, e, mass=0.0705, inertia=1.169e-5, centre=(0.02308, 0.00916))
    k6 = bar("K6", f, h, mass=0.00706, inertia=5.667e-7, centre=(0.01421, 0))
    k7 = bar("K7", A, h, mass=0.05498, inertia=1.912e-5, centre=(0.00449, -0.01228))
    bodies = (k1, k2, k3, k4, k5, k6, k7)
    pins = (("P", k1.b, k2.a), ("F2", k2.b, k3.b), ("F4", k4.a, k3.b), ("F6", k6.a, k3.b), ("E", k4.b, k5.b))
    pins += (("H", k6.b, k7.b), ("O", k1.a, GROUND.at(*ORIGIN)), ("B", k3.a, GROUND.at(*B)))
    pins += (("A5", k5.a, GROUND.at(*A)), ("A7", k7.a, GROUND.at(*A)))
    spring = SpringDamper("spring", k3.at(0.018, 0.02), GROUND.at(*C), stiffness=4530.0, free_length=0.07785)
    joints = tuple(Revolute(*pin) for pin in pins)
    outputs = tuple(Output(body.name, body.angle, f"Angle of {body.name}", "rad") for body in bodies)
    motor = Torque("motor", k1, torque=values.torque)
    return Mechanism(bodies, joints, (motor, spring), outputs=outputs, held=(k1.angle,))


PARAMETERS = (torque_parameter("torque", "33 mN.m", "Torque on K1"), *settings_parameters())
MODEL = Model("Andrews", "Andrews' squeezing mechanism", PARAMETERS, mechanism, stop_time=0.03, step_size=1e-4)
