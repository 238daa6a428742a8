"""A small model with one variable of every kind: a driven arm that may hit a wall."""

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    Calculated,
    Input,
    Mechanism,
    Model,
    Output,
    Parameter,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
)


def _mechanism(values: SimpleNamespace) -> Mechanism:
    half = values.length / 2
    return Mechanism(
        bodies=(Body("arm", values.mass, values.mass * values.length**2 / 12, (half, 0.0, 0.0)),),
        joints=(Revolute("hinge", "arm", (-half, 0.0), GROUND, (0.0, 0.0)),),
        forces=(Torque("drive", "arm"),),
        contacts=(PointLineContact("wall", "arm", (half, 0.0), GROUND, (0.0, 0.5), (0.0, -1.0)),),
        inputs=(
            Input("bias", "drive.torque", 0.0, "Constant torque", "N.m"),
            Input("torque", "drive.torque", 0.25, "Torque on the arm", "N.m", -1.0, 1.0, "mN.m"),
        ),
        outputs=(
            Output("angle", "arm.angle", "Angle of the arm", "rad", "deg", nominal=2.0),
            Output("wall_force", "wall.force", "Force of the wall", "N", feedthrough=("torque", "bias")),
            Output("impact_count", "impact.count", "Impacts so far", type="Integer"),
            Output("impact", "impact.any", "An impact in the last step", type="Boolean"),
            Output("impacts[1].time", "impacts[1].time", "Time of the first impact of the step", "s"),
        ),
        calculated=(Calculated("inertia", values.mass * values.length**2 / 3, "About the hinge", "kg.m2"),),
        settings=Settings(relative_tolerance=1e-8),
    )


MODEL = Model(
    "Pendulum",
    "An arm & a wall",
    (
        Parameter("length", 1.5, "Length of the arm", "m", 0.1, 10.0, display_unit="mm"),
        Parameter("mass", 0.1 + 0.2, "Mass of the arm", "kg", 0.0),
        Parameter("teeth", 3.0, "A number", minimum=3, maximum=100, type="Integer"),
        Parameter("guided", 1.0, "A switch", type="Boolean"),
    ),
    _mechanism,
    stop_time=2.0,
    step_size=1e-2,
    drawing=(),
)
