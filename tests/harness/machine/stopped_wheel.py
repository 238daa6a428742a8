"""A wheel on a compliant shaft, with a stop: a neighbour that strikes when the one that turns it has made it move."""

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    CompliantShaft,
    Mechanism,
    Model,
    Output,
    Revolute,
    angle_parameter,
    body_angle_output,
    body_speed_output,
    fraction_parameter,
    impact_outputs,
    inertia_parameter,
    settings_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
)

_IMPACT = Output("closing_speed", "closing_speed", "Speed before, {impact}", "rad/s")


def mechanism(values):
    """The wheel, which stands at 0 and may turn up to `stop_angle`."""
    return Mechanism(
        bodies=(Body("wheel", 1.0, values.inertia),),
        joints=(Revolute("hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(CompliantShaft("shaft", "wheel", stiffness=values.drive_stiffness, damping=values.drive_damping),),
        contacts=(AngleStop("stop", GROUND, "wheel", angle=-values.stop_angle, restitution=values.restitution),),
        inputs=shaft_inputs(speed=0.0),
        outputs=(
            body_angle_output("wheel", "phi"),
            body_speed_output("wheel"),
            shaft_torque_output("wheel"),
            *impact_outputs("Impacts on the stop", [_IMPACT]),
        ),
        held=("wheel.angle",),
    )


MODEL = Model(
    name="StoppedWheel",
    description="Wheel on a compliant shaft with a stop",
    parameters=(
        inertia_parameter("inertia", 0.02, "Inertia of the wheel"),
        angle_parameter("stop_angle", 0.01, "Angle at which the stop is"),
        fraction_parameter("restitution", 0.5, "Of the stop"),
        *shaft_parameters(damping=0.0),
        *settings_parameters(),
    ),
    mechanism=mechanism,
)
