"""Measured orders of the step and of its dense output, on a pinned body whose swing is known exactly.

The centre of mass goes round the hinge on a circle, so that the joint's rows take part in every stage; a torsion
spring about the hinge makes the angle AMPLITUDE cos(FREQUENCY t). A driver can lead the body through the same motion:
then the stages must be taken at their own times, too.
"""

import math

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.acceleration import derivative
from mechanism_fmu.engine.dynamics.forces import set_time
from mechanism_fmu.engine.interpolation import interpolate
from mechanism_fmu.engine.stepping.runge_kutta import try_step
from mechanism_fmu.engine.vectors import copy
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    Output,
    Revolute,
    Settings,
    TorsionSpring,
    harmonic_motion,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import pack
from mechanism_fmu.tables.method import METHOD
from mechanism_fmu.tables.motion import Course, Implicit, Stages

MASS, INERTIA, RADIUS = 2.0, 0.3, 0.5
FREQUENCY, AMPLITUDE = 1.5, 1.2
END = 2.0
NAMES = ("x", "y", "angle", "x_rate", "y_rate", "speed")
#: Where inside a step its dense output is looked at.
FRACTIONS = np.linspace(0.1, 0.9, 9)


HINGE = Revolute("hinge", "bob", (-RADIUS, 0.0), GROUND, (0.0, 0.0))
SPRING = TorsionSpring("spring", "bob", stiffness=(INERTIA + MASS * RADIUS**2) * FREQUENCY**2)
DRIVER = AngleDriver("driver", "bob", harmonic_motion(0.0, AMPLITUDE, FREQUENCY, math.pi / 2))
#: What makes the bob swing.
CAUSES = {"spring": {"joints": (HINGE,), "forces": (SPRING,)}, "driver": {"joints": (HINGE, DRIVER)}}


#: By which numbers the methods are asked for, and their orders.
METHODS = {"Dormand-Prince": codes.EXPLICIT, "Rodas5P": codes.IMPLICIT_METHOD}


def swing(tolerance=1e-9, alpha=10.0, beta=1.0, cause="spring", method=codes.EXPLICIT):
    x, y, angle = exact(0.0)[:3]
    return Mechanism(
        bodies=(Body("bob", MASS, INERTIA, (x, y, angle)),),
        **CAUSES[cause],
        outputs=tuple(Output(name, f"bob.{name}", "") for name in NAMES),
        settings=Settings(tolerance, baumgarte_alpha=alpha, baumgarte_beta=beta, integration_method=method),
    )


def exact(time):
    """(x, y, angle) and their rates."""
    angle = AMPLITUDE * math.cos(FREQUENCY * time)
    speed = -AMPLITUDE * FREQUENCY * math.sin(FREQUENCY * time)
    x, y = RADIUS * math.cos(angle), RADIUS * math.sin(angle)
    return np.array([x, y, angle, -y * speed, x * speed, speed])


@entry
def fixed_steps(block, y, start, step, count, fractions, inside):
    """Take `count` steps from y, in place; `inside`, shape (fractions, unknowns), is the last one's dense output."""
    s = Stages(block)
    for k in range(count):
        copy(y, s.y_start)
        set_time(block, start + k * step)
        derivative(block, y, s.derivatives[0])
        Implicit(block).fresh[0] = 0
        try_step(block, start + k * step, step)
        copy(s.y_new, y)
    for f in range(fractions.shape[0]):
        interpolate(s.new_dense, fractions[f], inside[f])


def errors_of_steps(cause, start, step, count, method=codes.EXPLICIT, beta=1.0):
    """Largest error at the end of `count` steps from the exact state at `start`, and inside the last one.

    Without Baumgarte's damping, whose own time scale would hide the order until the steps are much smaller. And inside
    the last one of the coordinates alone.
    """
    y = np.append(exact(start), [0.0, 0.0])  # no work, no loss
    inside = np.zeros((len(FRACTIONS), len(y)))
    block = pack(compile_mechanism(swing(alpha=0.0, beta=beta, cause=cause, method=method)))
    Course(block).scales[:] = Course(block).body_scales[:] = 1.0  # which else is written where a motion begins
    Course(block).counters[codes.IMPLICIT] = method == codes.IMPLICIT_METHOD
    fixed_steps(block, y, start, step, count, FRACTIONS, inside)
    times = start + step * (count - 1 + FRACTIONS)
    between = [row[:6] - exact(time) for row, time in zip(inside, times, strict=True)]
    return np.abs(y[:6] - exact(start + step * count)).max(), np.abs(between).max(), np.abs(between)[:, :3].max()


def orders(errors):
    """Exponents with which errors fall when the step is halved each time."""
    return np.log2(np.divide(errors[:-1], errors[1:]))


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_order_of_the_step_is_five(method):
    errors = [errors_of_steps("spring", 0.0, END / count, count, method)[0] for count in (32, 64, 128)]
    assert np.all(orders(errors) > METHOD.order - 0.1)
    assert np.all(orders(errors) < METHOD.order + 0.4)


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_order_of_the_step_is_five_in_time_too(method):
    """A single node of the method that is off by 1 % leaves order 1."""
    # an implicit step mends the rates that the driver gives exactly: of more steps only rounding is left
    counts = (32, 64, 128, 256) if method == codes.EXPLICIT else (16, 32, 64)
    errors = [errors_of_steps("driver", 0.0, END / count, count, method)[0] for count in counts]
    within = 0.1 if method == codes.EXPLICIT else 0.25  # differences with time lack digits
    assert orders(errors).mean() == pytest.approx(METHOD.order, abs=within)


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
@pytest.mark.parametrize("cause", CAUSES)
@pytest.mark.parametrize("start", [0.0, 0.5, 1.0, 1.5])
def test_order_of_the_dense_output_is_four(start, cause, method):
    """Inside a single step from the exact state the error is of order 5; a cubic would leave one of order 4."""
    errors = [errors_of_steps(cause, start, 0.08 / part, 1, method)[1] for part in (1, 2, 4, 8)]
    found = orders(errors)
    if method == codes.EXPLICIT:
        np.testing.assert_allclose(found[:2], METHOD.dense_order + 1, atol=0.1)
    else:  # terms of the next order are still seen, one way or the other
        assert found.mean() == pytest.approx(METHOD.dense_order + 1, abs=0.2)


@pytest.mark.parametrize("cause", CAUSES)
@pytest.mark.parametrize("start", [0.0, 0.5, 1.0, 1.5])
def test_order_of_coordinates_between_steps_is_five_without_gains(start, cause):
    """The quintic through places, rates and accelerations: inside a single step the error is of order 6."""
    errors = [errors_of_steps(cause, start, 0.08 / part, 1, beta=0.0)[2] for part in (1, 2, 4)]
    assert orders(errors).mean() == pytest.approx(6.0, abs=0.3)


#: Above the first range of tolerances every step drifts by more than `acceleration.MOST_DRIFT` and is put back on the
#: joints;
#: below the second none does. Each way of stepping has an error constant of its own, so each has a line of its own.
REGIMES = {"mended": 10.0 ** np.arange(-5, -8.01, -0.125), "not mended": 10.0 ** np.arange(-10, -12.01, -0.125)}


@pytest.mark.parametrize("regime", REGIMES)
@pytest.mark.parametrize("end", [0.5, 2.0, 10.0])
def test_the_error_is_proportional_to_the_tolerance(end, regime):
    tolerances = REGIMES[regime]
    errors = [error_at(end, tolerance) for tolerance in tolerances]
    slope, _ = np.polyfit(np.log(tolerances), np.log(errors), 1)
    assert slope == pytest.approx(1.0, abs=0.12)
    assert np.all(errors < 30 * end * tolerances)


@pytest.mark.parametrize("end", [0.5, 2.0, 10.0])
def test_the_error_stays_below_the_tolerance_where_mending_sets_in(end):
    tolerances = 10.0 ** np.arange(-8, -10.01, -0.125)
    assert np.all([error_at(end, tolerance) for tolerance in tolerances] < 30 * end * tolerances)


def error_at(end, tolerance):
    simulation = Simulation(swing(tolerance))
    simulation.advance(end)
    return np.abs([simulation.read()[name] for name in NAMES] - exact(end)).max()


def test_outputs_between_the_engines_steps_are_as_accurate():
    """The dense output is of lower order than the step; at the engine's own steps it must not show."""
    simulation = Simulation(swing())
    errors = []
    for time in np.linspace(0, 10, 500):
        simulation.advance(time)
        errors.append([simulation.read()[name] for name in NAMES] - exact(time))
    assert np.abs(errors).max() < 1e-7
