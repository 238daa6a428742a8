"""The FMU in fmpy's own simulation loop."""

import shutil

import numpy as np
import pytest
from fmpy import simulate_fmu

from tests.fmu.conformance.host import Fmu, Instance


def test_simulate_fmu_does_what_a_loop_by_hand_does(subject, instance):
    """Start values, an input that jumps, outputs of all types, and the stop time, which fmpy may miss in silence.

    All is the same to the last bit.
    """
    name, levels = next(iter(subject.inputs.items()))
    # fmpy interpolates what is constant, too. With few bits nothing is rounded there; otherwise the input would change
    # by its last bit now and then, and the motion, begun anew at that time, differ within its tolerance, which bounces
    # magnify (cam drive: 5e-9 of energy_lost).
    low, high = np.array(levels, np.float16).tolist()
    signal = np.array([(0.0, low), (1.0, low), (1.0, high), (9.0, high)], dtype=[("time", float), (name, float)])
    of_impacts = ["impact_time", "impact_count", "impact"] if subject.impacts else []
    result = simulate_fmu(
        subject.fmu.folder,
        stop_time=subject.until,
        output_interval=0.125,
        start_values=dict(subject.rough),
        input=signal,
        output=[*of_impacts, "kinetic_energy", "energy_lost"],
    )
    one = instance()
    one.begin({**subject.rough, name: low})
    for k in range(round(subject.until / 0.125)):
        one.set({name: low if one.time < 1.0 else high})
        one.step(0.125)
        row = result[np.argmin(abs(result["time"] - 0.125 * (k + 1)))]
        assert one["kinetic_energy"] == row["kinetic_energy"]
    assert result["time"][-1] == pytest.approx(subject.until, rel=1e-12)
    subject.assert_struck(one)
    for output in (*of_impacts, "energy_lost"):
        assert result[output][-1] == one[output]


def test_a_path_with_spaces_is_no_trouble(subject, tmp_path):
    folder = tmp_path / "my FMUs" / "one of them"
    shutil.copytree(subject.fmu.folder, folder)
    with Instance(Fmu.at(str(folder))) as one:
        one.begin().step(0.1)
