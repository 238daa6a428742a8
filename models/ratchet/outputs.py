"""Outputs of the ratchet."""

from __future__ import annotations

from mechanism_fmu.model import (
    Output,
    active_output,
    angle_output,
    body_angle_output,
    body_speed_output,
    energy_outputs,
    event_buffer_outputs,
    force_output,
    hinged_beam_outputs,
    impact_buffer_outputs,
    last_impact_outputs,
    shaft_torque_output,
    torque_output,
    whole_output,
)

from .impacts import EVENT, IMPACT, LAST_IMPACT
from .inputs import INPUTS, SHAFT

OUTPUTS = (
    body_angle_output("wheel", "psi"),
    body_angle_output("crank", "phi"),
    body_angle_output("pawl", "gamma"),
    body_speed_output("wheel", "omega", nominal=0.1),
    body_speed_output("crank", nominal=0.1),
    body_speed_output("pawl", nominal=0.1),
    force_output(
        "contact_force", "face.force", "Normal force of the pawl on the tooth face, 0 when open", INPUTS, nominal=0.1
    ),
    force_output(
        "slope_force", "slope.force", "Normal force of the pawl on the tooth slope, 0 when open", INPUTS, nominal=0.1
    ),
    torque_output(
        "holding_pawl_torque",
        "holding_pawl.force",
        "Torque of the holding pawl on the wheel, 0 when open",
        INPUTS,
        nominal=0.01,
    ),
    shaft_torque_output("crank", nominal=0.01, shaft=SHAFT),
    Output("face_gap", "face.gap", "Distance of the pawl's tip from the tooth face", "m", nominal=0.01),
    Output("slope_gap", "slope.gap", "Distance of the pawl's tip from the tooth slope", "m", nominal=0.01),
    whole_output("tooth_index", "teeth.index", "Index of the tooth at which the pawl stands, counted forwards"),
    angle_output("latched_angle", "holding_pawl.latched", "Wheel angle below which the holding pawl holds"),
    angle_output(
        "lost_motion",
        "holding_pawl.gap",
        "How far the wheel stands beyond the latched angle: what it goes back when the pawl leaves it",
    ),
    whole_output("clicks", "holding_pawl.clicks", "Teeth that the holding pawl has passed since the start"),
    active_output("slope", "The pawl's tip slides on the tooth slope"),
    active_output("face", "The pawl's tip stands on the tooth face"),
    active_output("holding_pawl", "The holding pawl holds the wheel"),
    whole_output("event_count", "event.count", "Events since the start: impacts, openings, clicks, changes of tooth"),
    *last_impact_outputs("Impacts", LAST_IMPACT),
    *impact_buffer_outputs(IMPACT),
    *event_buffer_outputs(EVENT),
    *energy_outputs(
        kinetic="Kinetic energy of all bodies",
        spring="Energy of the wheel's spring, without preload",
        work="Work done by inputs and pawl spring since the start",
        lost="Energy lost in impacts, friction and dampers since the start",
        nominal=1e-4,
    ),
    *hinged_beam_outputs("pawl", "pawl_beam", "pawl", INPUTS, deflection=1e-9, stress=1e3),
)
