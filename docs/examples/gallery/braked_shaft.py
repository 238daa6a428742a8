"""Braked shaft: a turning shaft is clutched to one at rest; the clutch slips until both turn alike, a brake stops them.

Brake and clutch hold up to their torques, and slip beyond. Source: closed form, constant torques between the changes.
"""

from mechanism_fmu.model import (
    GROUND,
    Brake,
    Input,
    Mechanism,
    Model,
    Output,
    Revolute,
    Torque,
    angle_output,
    disc,
    settings_parameters,
    speed_output,
    speed_parameter,
    torque_parameter,
)


def mechanism(values):
    """Both shafts, drawn as discs beside each other; the brake is on the second."""
    first = disc("first", radius=0.2, mass="20 kg", speed=values.speed)
    second = disc("second", at=(0.5, 0), radius=0.25, mass="32 kg")
    joints = (Revolute("first_bearing", first, GROUND), Revolute("second_bearing", second, GROUND.at(0.5, 0)))
    forces = (
        Torque("drive", first),
        Brake("clutch", first, second, limit=values.clutch),
        Brake("brake", second, limit=values.brake),
    )
    inputs = (Input("drive", "drive.torque", 2.0, "On the first shaft", "N.m"),)
    torque = {"feedthrough": ("drive",)}
    outputs = (
        *(angle_output("first_angle", first.angle, "First shaft"), speed_output("first", first.speed, "First shaft")),
        *(angle_output("second_angle", second.angle, "Second shaft"), speed_output("second", second.speed, "Second")),
        Output("clutch_torque", "clutch.friction_force", "On the first shaft", "N.m", **torque),
        Output("brake_torque", "brake.friction_force", "On the second shaft", "N.m", **torque),
        *(Output("clutched", "clutch.sticks", "Both alike", "1"), Output("braked", "brake.sticks", "It stands", "1")),
    )
    ports = {"inputs": inputs, "outputs": outputs}
    return Mechanism((first, second), joints, forces, **ports)


TORQUES = (torque_parameter("clutch", 9.0, "It holds"), torque_parameter("brake", 5.0, "It holds"))
PARAMETERS = (speed_parameter("speed", 40.0, "Of the first shaft at the start"), *TORQUES, *settings_parameters())
MODEL = Model("BrakedShaft", "Shaft with a clutch and a brake", PARAMETERS, mechanism, stop_time=20.0)
