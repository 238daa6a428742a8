"""Runs of the ratchet that tests of FMI 3.0 share."""

import pytest

#: The paper's base case, with the digits that the table has.
IMPACT = pytest.approx(0.9399211769, abs=5.1e-11)
AFTER = {"impact_crank_speed": 0.0191482997, "impact_pawl_speed": -0.0069073680, "impact_wheel_speed": 0.0227388573}
#: A bouncing pawl: eighteen impacts within two seconds.
ROUGH = {"guided": False, "restitution": 0.5, "tooth_count": 15, "drive_torque": 5e-3}


def impact_at(instance3):
    """Time of the base case's impact, to the last bit."""
    one = instance3(event_mode=True, early_return=True).begin()
    return next(step.reached for step in one.run(1.0, 10) if step.event)
