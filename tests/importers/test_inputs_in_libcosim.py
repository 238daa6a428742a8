"""libcosim writes an input before each step, and reads outputs of each step; the end values are in `test_matrix.py`."""

import pytest

from tests.fmu.conformance.host import Fmu, Instance

pytest.importorskip("libcosimpy", reason="libcosimpy is not installed")

from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

STEP = 10_000_000  # ns
OUTPUTS = ("wheel_angle", "crank_angle", "impact_time")


def test_libcosim_steps_it_through_the_impact(native_ratchet_fmu, tmp_path):
    native_ratchet = Fmu.unzip(native_ratchet_fmu, tmp_path)
    references = [native_ratchet.variables[name].valueReference for name in OUTPUTS]
    torque = native_ratchet.variables["drive_torque"].valueReference

    execution = CosimExecution.from_step_size(step_size=STEP)
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(native_ratchet_fmu), instance_name="ratchet"))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer=observer)
    series = CosimObserver.create_time_series(buffer_size=200)
    assert execution.add_observer(observer=series)
    assert series.start_time_series(slave, references[0], CosimVariableType.REAL)
    manipulator = CosimManipulator.create_override()
    assert execution.add_manipulator(manipulator=manipulator)

    found, expected = [], []
    with Instance(native_ratchet) as one:
        one.begin()
        for k in range(150):
            value = 1e-3 + 2e-6 * k
            assert manipulator.slave_real_values(slave, [torque], [value])
            assert execution.step()
            found.append(observer.last_real_values(slave, references))
            one.set({"drive_torque": value})
            one.slave.doStep(k * STEP * 1e-9, STEP * 1e-9)
            expected.append(list(one.get(OUTPUTS).values()))
    assert expected[-1][2] > 0
    assert found == [pytest.approx(outputs, rel=1e-12) for outputs in expected]
    assert execution.status().current_time == 150 * STEP
