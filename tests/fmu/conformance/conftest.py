"""The FMUs that every conformance test runs on, in both flavours: a new model is one more entry of `SUBJECTS`.

Its two flavours are built by fixtures of its name, in tests/conftest.py and tests/fmu/conftest.py.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import pytest

from tests.fmu.conformance.alone import refusals, run_alone
from tests.fmu.conformance.host import Instance
from tests.fmu.conformance.subject import Subject
from tests.once import once

#: By the name of the session fixture that gives the unzipped FMU; the native flavour's has "native_" before it.
SUBJECTS: dict[str, dict[str, Any]] = {
    "ratchet": {
        "rough": {"restitution": 0.5, "tooth_count": 15},
        "inputs": {"drive_torque": (5e-4, 3e-3), "spring_preload": (0.0, 1e-3), "load_torque": (-1e-4, 1e-4)},
        "until": 2.0,
        "impossible": {"pawl_length": 0.03},
    },
    # The pawl bounces into the notch, and the shaft swings it back over the tips.
    "ratchet_free": {
        "rough": {
            "restitution": 0.5,
            "crank_angle_start": 1.3,
            "drive_stiffness": 2.0,
            "drive_damping": 0.01,
            "pawl_spring_torque": 5e-3,
            "friction": 0.1,
        },
        "inputs": {"drive_torque": (-5e-3, 2e-2), "drive_angle": (1.2, 1.7), "load_torque": (-1e-2, 1e-2)},
        "until": 2.0,
        "impossible": {"pawl_length": 0.03},
    },
    # A spring pulls the driver back, through its slot, on a backstop, where it bounces.
    "geneva": {
        "rough": {
            "slot_count": 6,
            "driver_speed_start": 20.0,
            "drive_damping": 0.0,
            "drive_stiffness": 0.3,
            "backstop": True,
            "backstop_restitution": 0.5,
        },
        "inputs": {"drive_torque": (-0.05, 0.05), "load_torque": (-0.01, 0.01), "drive_speed": (3.0, 7.0)},
        "until": 2.0,
        "impossible": {"pin_diameter": 0.05},
    },
    # The pin strikes both walls of its slot, and the wheel bounces in its arc.
    "geneva_clearance": {
        "rough": {"restitution": 0.5, "driver_angle_start": 1.5, "slot_clearance": 5e-4, "wheel_damping": 1e-3},
        "inputs": {"drive_torque": (-0.05, 0.05), "load_torque": (-0.01, 0.01), "drive_speed": (3.0, 7.0)},
        "until": 1.0,
        "impossible": {"pin_diameter": 0.05},
    },
    # Without contacts there are no impacts: weight, friction and a soft shaft or a spring make the run uneven.
    "slider_crank": {
        "rough": {
            "offset": 0.03,
            "rod_length": 0.15,
            "crank_speed_start": 12.0,
            "gravity": 9.81,
            "drive_stiffness": 0.3,
            "slider_friction": 0.1,
        },
        "inputs": {"drive_torque": (-0.05, 0.05), "load_force": (-1.0, 1.0), "drive_speed": (3.0, 7.0)},
        "until": 2.0,
        "impossible": {"offset": 0.3},
        "impacts": False,
        "sticks": True,
    },
    "four_bar": {
        "rough": {
            "crossed": True,
            "crank_angle_start": 1.0,
            "crank_speed_start": 12.0,
            "gravity": 9.81,
            "spring_stiffness": 0.05,
            "crank_damping": 1e-3,
        },
        "inputs": {"drive_torque": (-0.05, 0.05), "load_torque": (-0.05, 0.05), "drive_speed": (3.0, 7.0)},
        "until": 2.0,
        "impossible": {"rocker_length": 0.4},
        "impacts": False,
    },
    # Its links bend: outputs that the accelerations of the very instant decide.
    "four_bar_path_generator": {
        "rough": {
            "crossed": True,
            "crank_angle_start": 1.0,
            "crank_speed_start": 30.0,
            "arm_angle": -1.0,
            "arm_depth": 8e-3,
            "drive_stiffness": 20.0,
            "drive_damping": 2.0,
        },
        "inputs": {"drive_torque": (-2.0, 2.0), "drive_speed": (40.0, 60.0)},
        "until": 0.5,
        "impossible": {"rocker_length": 0.6},
        "impacts": False,
    },
    "gear_train": {
        "rough": {
            "pinion_angle_start": 1.0,
            "pinion_speed_start": 12.0,
            "drive_stiffness": 2.0,
            "wheel_damping": 1e-2,
            "joint_friction_radius": 1e-3,
        },
        "inputs": {"drive_torque": (-1.0, 2.0), "load_torque": (-1.0, 1.0), "drive_speed": (3.0, 7.0)},
        "until": 2.0,
        "impossible": {"pinion_radius": 900.0},
        "impacts": False,
        "sticks": True,
    },
    # So fast that the roller leaves the cam again and again, lands and bounces, until a spring turns it back.
    "cam_drive": {
        "rough": {
            "unilateral": True,
            "restitution": 0.5,
            "cam_speed_start": 38.0,
            "drive_damping": 0.0,
            "drive_stiffness": 0.05,
            "joint_friction_radius": 1e-4,
        },
        "inputs": {"drive_torque": (-0.02, 0.02), "load_torque": (-0.005, 0.005), "drive_speed": (3.0, 7.0)},
        "until": 2.0,
        "impossible": {"lift": 0.2},
    },
    # The voltage is at its limit, off it, and at it again.
    "motor": {
        "rough": {"rotor_angle_start": 1.0, "rotor_speed_start": -20.0, "voltage_limit": 8.0, "rotor_damping": 1e-2},
        "inputs": {"speed_reference": (-60.0, 60.0), "load_torque": (-0.5, 0.5)},
        "until": 2.0,
        "impossible": {"inductance": 1e-9},
        "impacts": False,
    },
    # The table sticks and slips.
    "rotary_table": {
        "rough": {"table_angle_start": 0.2, "table_speed_start": 3.0, "table_damping": 1e-2},
        "inputs": {"drive_angle": (-1.0, 1.0), "load_torque": (-0.3, 0.3), "brake_torque": (0.0, 0.4)},
        "until": 2.0,
        "impacts": False,
        "sticks": True,
    },
    # Escapements, with more torque than by default.
    "verge": {
        "rough": {"foliot_inertia": 1e-5, "wheel_inertia": 1e-5, "tip_radius": 3e-4},
        "inputs": {"drive_torque": (5e-4, 2e-3), "load_torque": (-2e-4, 2e-4)},
        "until": 2.0,
        "impossible": {"tip_radius": 1e-3},
    },
    "recoil_anchor": {
        "rough": {"pendulum_length": 0.25, "pendulum_damping": 5e-3, "pendulum_angle_start": -0.12},
        "inputs": {"drive_torque": (0.012, 0.03), "load_torque": (-5e-3, 5e-3)},
        "until": 2.0,
        "impossible": {"tip_radius": 1e-3},
    },
    "graham": {
        "rough": {"pendulum_length": 0.25, "pendulum_damping": 5e-3, "pendulum_angle_start": -0.08},
        "inputs": {"drive_torque": (0.012, 0.03), "load_torque": (-5e-3, 5e-3)},
        "until": 2.0,
        "impossible": {"tip_radius": 3e-4},
    },
    "pin_pallet": {
        "rough": {"frequency": 4.0, "quality": 20.0, "balance_angle_start": -0.12},
        "inputs": {"drive_torque": (5e-4, 1.2e-3), "load_torque": (-2e-4, 2e-4)},
        "until": 2.0,
        "impossible": {"pin_radius": 8e-4},
    },
    "lever_escapement": {
        "rough": {"quality": 50.0, "draw_angle": 0.25, "balance_angle_start": 1.5},
        "inputs": {"drive_torque": (2e-3, 6e-3), "load_torque": (-1e-3, 1e-3)},
        "until": 2.0,
        "impossible": {"pallet_thickness": 6e-3},
    },
}


#: The rest is slow: wrapper and C surface are the same for all models.
FAST = ("ratchet", "native_ratchet")
PARAMETERS = [
    pytest.param(flavour + name, marks=() if flavour + name in FAST else pytest.mark.slow)
    for name in SUBJECTS
    for flavour in ("", "native_")
]


#: Those of models that refuse some values, each within its limits, together.
REFUSING = [param for param in PARAMETERS if "impossible" in SUBJECTS[str(param.values[0]).removeprefix("native_")]]


@pytest.fixture(scope="session", params=PARAMETERS)
def subject(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Subject:
    """An FMU that has shown in another process that what it refuses does not end the host."""
    return _subject(request, tmp_path_factory)


@pytest.fixture(scope="session", params=REFUSING)
def refusing(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Subject:
    """A subject with values that no mechanism can have together."""
    return _subject(request, tmp_path_factory)


def _subject(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Subject:
    fmu = request.getfixturevalue(request.param)
    once(tmp_path_factory, f"refusals_{request.param}", lambda _: run_alone(refusals, fmu.folder))
    native = request.param.startswith("native_")
    return Subject(fmu, native=native, **SUBJECTS[request.param.removeprefix("native_")])


@pytest.fixture
def instance(subject: Subject) -> Iterator[Callable[..., Instance]]:
    """A function that makes instances of the FMU; they are freed after the test."""
    with ExitStack() as stack:
        yield lambda *args, **kwargs: stack.enter_context(Instance(subject.fmu, *args, **kwargs))
