"""Builders of common ports: one name, one unit, one set of limits and one meaning everywhere.

A builder returns a plain `Input`, `Output` or `Parameter`, or several in a tuple, to be unpacked with a star; what is
not here is written as such. Names end in `_input`, `_output` or `_parameter`, with an s where several are returned.
Builders that are given a part ("crank") form the names of its ports from it ("crank_angle"). All can be imported from
`mechanism_fmu.model`, like the parts; where many are used, `from mechanism_fmu.model import port_builders as ports`.
"""

from .outputs import (
    active_output as active_output,
    angle_output as angle_output,
    bent_point_outputs as bent_point_outputs,
    body_angle_output as body_angle_output,
    body_motion_outputs as body_motion_outputs,
    body_speed_output as body_speed_output,
    energy_outputs as energy_outputs,
    flag_output as flag_output,
    force_output as force_output,
    friction_outputs as friction_outputs,
    hinged_beam_outputs as hinged_beam_outputs,
    member_outputs as member_outputs,
    shaft_torque_output as shaft_torque_output,
    speed_output as speed_output,
    torque_output as torque_output,
    whole_output as whole_output,
)
from .parameters import (
    angle_parameter as angle_parameter,
    body_parameters as body_parameters,
    damping_parameter as damping_parameter,
    flag_parameter as flag_parameter,
    fraction_parameter as fraction_parameter,
    inertia_parameter as inertia_parameter,
    joint_friction_parameter as joint_friction_parameter,
    length_parameter as length_parameter,
    link_parameters as link_parameters,
    load_torque_input as load_torque_input,
    mass_parameter as mass_parameter,
    rotor_parameters as rotor_parameters,
    settings_parameters as settings_parameters,
    shaft_inputs as shaft_inputs,
    shaft_parameters as shaft_parameters,
    speed_parameter as speed_parameter,
    stiffness_parameter as stiffness_parameter,
    torque_input as torque_input,
    torque_parameter as torque_parameter,
)
from .records import (
    event_buffer_outputs as event_buffer_outputs,
    impact_buffer_outputs as impact_buffer_outputs,
    impact_outputs as impact_outputs,
    impact_speed_fields as impact_speed_fields,
    last_impact_outputs as last_impact_outputs,
)
