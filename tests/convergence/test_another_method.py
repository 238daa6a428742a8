"""Another method needs its own file only: with Bogacki-Shampine's 3(2) in place, all that names stages follows."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from mechanism_fmu.tables.method import METHOD, method
from mechanism_fmu.tables.motion import Course, Stages

ROOT = Path(__file__).parents[2]
PLUGIN = "tests.convergence.another_method"


def without_compiler(*arguments):
    """What Python prints, from the root of the tree."""
    paths = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": paths}
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def measured():
    done = without_compiler("tests/convergence/another_method.py")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_tables_take_their_sizes_from_the_method(measured):
    """Four stages, and a dense output without rows beyond the cubic."""
    assert (measured["derivatives"], measured["dense"], measured["new_dense"]) == (4, 4, 4)


@pytest.mark.parametrize("cause", ["spring", "driver"])
def test_orders_of_step_and_dense_output(measured, cause):
    """The local error of the dense output, of order 3, is of one order more."""
    assert measured[f"step, {cause}"] == pytest.approx([3.0, 3.0], abs=0.05)
    assert measured[f"dense output, {cause}"] == pytest.approx([4.0, 4.0], abs=0.1)


def test_step_size_control_takes_its_exponent_from_the_method(measured):
    """The estimate is of order 2, so its error grows with h^3; with Dormand-Prince's h^5 this would be -0.2."""
    assert measured["steps"] == pytest.approx(-1 / 3, abs=0.01)


@pytest.mark.parametrize("what", ["error", "instant of the impact"])
def test_errors_are_proportional_to_the_tolerance(measured, what):
    assert measured[what] == pytest.approx(1.0, abs=0.1)


def test_singular_configurations_and_impacts_are_found_by_any_method():
    """The first looks at the stages inside the step, the second at its dense output."""
    tests = (
        "tests/analytic/test_refused_step.py",
        "tests/analytic/test_bouncing_ball.py::test_{}[0.3]".format("impact_times_up_to_the_stick_speed_and_then_rest"),
    )
    done = without_compiler("-m", "pytest", "-p", PLUGIN, "-p", "no:cacheprovider", *tests)
    assert done.returncode == 0, done.stdout


def test_the_engines_own_method():
    """Rows of a tableau add up to its nodes, weights of a result to 1, those of an error to 0."""
    assert METHOD.a.sum(axis=1) == pytest.approx(METHOD.c, abs=1e-14)
    assert METHOD.error.sum() == pytest.approx(0.0, abs=1e-15)
    assert METHOD.dense.sum(axis=1) == pytest.approx([0.0], abs=1e-13)
    assert (METHOD.stages, METHOD.last, METHOD.interior, METHOD.error_exponent) == (7, 6, (1, 2, 3, 4), 5)
    assert Stages.fields["derivatives"].shape[0] == Stages.fields["independence"].shape[0] == METHOD.stages
    assert Course.fields["dense"].shape[0] == Stages.fields["new_dense"].shape[0] == METHOD.dense_rows == 6


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"c": (0.0, 1.0), "a": ((), (1.0,)), "error": (1.0, -1.0)}, "3 or more"),
        ({"c": (0.0, 0.5, 1.0), "a": ((), (0.5,), (1.0,)), "error": (1.0, -1.0, 0.0)}, r"got \[0, 1, 1\]"),
        ({"c": (0.0, 0.5, 0.9), "a": ((), (0.5,), (0.0, 1.0)), "error": (1.0, -1.0, 0.0)}, "Append one at 1"),
        ({"c": (0.0, 0.5, 1.0), "a": ((), (0.5,), (0.0, 1.0)), "error": (1.0, -1.0)}, "3 stages need as many"),
    ],
)
def test_what_is_no_tableau_is_refused(given, message):
    with pytest.raises(ValueError, match=message):
        method("odd", **given, orders=(2, 1, 2))
