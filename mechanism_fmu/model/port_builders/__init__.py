"""Builders of the ports that many mechanisms have: one name, one unit, one set of limits and one meaning everywhere.

A builder returns a plain `Input`, `Output` or `Parameter`, or several in a tuple, to be unpacked with a star; what is
not here is written as such. Names end in `_input`, `_output` or `_parameter`, with an s where several are returned.
Builders that are given a part ("crank") form the names of its ports from it ("crank_angle"). All are imported from
`mechanism_fmu.model`, like the parts.
"""

from .elastic import bent_point_outputs, hinged_beam_outputs, member_outputs
from .impacts import (
    event_buffer_outputs,
    impact_buffer_outputs,
    impact_outputs,
    impact_speed_fields,
    last_impact_outputs,
)
from .inputs import load_torque_input, shaft_inputs, torque_input
from .outputs import (
    active_output,
    angle_output,
    body_angle_output,
    body_speed_output,
    energy_outputs,
    flag_output,
    force_output,
    shaft_torque_output,
    speed_output,
    torque_output,
    whole_output,
)
from .part_parameters import (
    body_parameters,
    damping_parameter,
    joint_friction_parameter,
    link_parameters,
    rotor_parameters,
    settings_parameters,
    shaft_parameters,
)
from .quantity_parameters import (
    angle_parameter,
    flag_parameter,
    fraction_parameter,
    inertia_parameter,
    length_parameter,
    mass_parameter,
    speed_parameter,
    stiffness_parameter,
    torque_parameter,
)

__all__ = [
    "active_output",
    "angle_output",
    "angle_parameter",
    "bent_point_outputs",
    "body_angle_output",
    "body_parameters",
    "body_speed_output",
    "damping_parameter",
    "energy_outputs",
    "event_buffer_outputs",
    "flag_output",
    "flag_parameter",
    "force_output",
    "fraction_parameter",
    "hinged_beam_outputs",
    "impact_buffer_outputs",
    "impact_outputs",
    "impact_speed_fields",
    "inertia_parameter",
    "joint_friction_parameter",
    "last_impact_outputs",
    "length_parameter",
    "link_parameters",
    "load_torque_input",
    "mass_parameter",
    "member_outputs",
    "rotor_parameters",
    "settings_parameters",
    "shaft_inputs",
    "shaft_parameters",
    "shaft_torque_output",
    "speed_output",
    "speed_parameter",
    "stiffness_parameter",
    "torque_input",
    "torque_output",
    "torque_parameter",
    "whole_output",
]
