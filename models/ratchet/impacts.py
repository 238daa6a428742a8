"""What the ratchet reports of an impact and of an event, as fields of `mechanism_fmu.model.port_builders`."""

from __future__ import annotations

from mechanism_fmu.model import Output, impact_speed_fields, whole_output

_NUMBERS = "(0 slope, 1 face, 2 holding pawl)"
_CONTACTS = f"Struck contact {_NUMBERS}"
_GUARDS = "0 gap closed, 1 force gone, 2 next tooth, 3 previous tooth, 4 click, 6 inputs changed"
_MODE = "sum of 1 slope, 2 face, 4 holding pawl"


_SPEEDS = impact_speed_fields("wheel", "crank", "pawl", nominal=0.1)
_VELOCITY = "v_I of the stress recovery, tooth_length times the jump of the wheel's speed"


#: Of the last impact. What all impacts of one instant share stands behind what is the contact's own.
LAST_IMPACT = (
    whole_output("tooth", "tooth", "Index of the tooth struck at the {impact}; -1 before the first"),
    whole_output("contact", "contact", f"{_CONTACTS} at the {{impact}}; -1 before the first"),
    Output(
        "closing_speed",
        "closing_speed",
        "Normal closing speed just before the {impact} (holding pawl: rad/s)",
        "m/s",
        nominal=0.1,
    ),
    Output(
        "impulse", "impulse", "Impulse on the struck contact at the {impact} (holding pawl: N.m.s)", "N.s", nominal=0.01
    ),
    Output("slope_impulse", "impulse:slope", "Impulse on the tooth slope at the {impact}", "N.s", nominal=0.01),
    Output("energy_lost", "energy_lost", "Energy lost at the instant of the {impact}", "J", nominal=1e-4),
    *_SPEEDS,
    Output("velocity", "velocity", f"{_VELOCITY} at the {{impact}}", "m/s", nominal=1e-3),
)

#: Of each impact of the last communication step.
IMPACT = (
    Output("time", "time", "Time of {impact}", "s"),
    whole_output("instant", "instant", "Number of the instant (the same for all its impacts): {impact}"),
    whole_output("tooth", "tooth", "Index of the tooth struck: {impact}"),
    whole_output("contact", "contact", f"{_CONTACTS}: {{impact}}"),
    Output(
        "closing_speed", "closing_speed", "Normal closing speed of {impact} (holding pawl: rad/s)", "m/s", nominal=0.1
    ),
    Output(
        "impulse",
        "impulse",
        "Impulse on the struck contact of {impact} (holding pawl: N.m.s)",
        "N.s",
        nominal=0.01,
    ),
    Output("energy_lost", "energy_lost", "Energy lost at the instant of {impact}", "J", nominal=1e-4),
    *_SPEEDS,
    Output("velocity", "velocity", f"{_VELOCITY} at the instant of {{impact}}", "m/s", nominal=1e-3),
)

#: Of each event of the last communication step.
EVENT = (
    Output("time", "time", "Time of {event}; -1 when there was none", "s"),
    whole_output("guard", "guard", f"What fired ({_GUARDS}; -1 none) of {{event}}"),
    whole_output("subject", "subject", f"Number of the contact {_NUMBERS}, or 0 the teeth, of {{event}}"),
    whole_output("old_mode", "old_mode", f"Closed contacts ({_MODE}) before {{event}}"),
    whole_output("new_mode", "new_mode", f"Closed contacts ({_MODE}) after {{event}}"),
    Output(
        "impulse",
        "impulse",
        "Impulse of the contacts that struck of {event} (of the holding pawl in N.m.s)",
        "N.s",
        nominal=0.01,
    ),
)
