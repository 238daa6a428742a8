"""Without numba: analysis runs as plain Python, and a motion without a compiled engine is refused with the way out."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]
HIDDEN = """
import importlib.util, sys
real = importlib.util.find_spec
importlib.util.find_spec = lambda name, *rest: None if name in ("numba", "llvmlite") else real(name, *rest)
sys.modules |= {"numba": None, "llvmlite": None}
from mechanism_fmu.fmu.native import objects
objects.is_bundled = lambda: False
from models.four_bar.model import MODEL
mechanism = MODEL.build(MODEL.values())
"""


def printed(program: str) -> str:
    environment = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    path = os.pathsep.join([str(ROOT), environment.get("PYTHONPATH", "")])
    command = [sys.executable, "-c", HIDDEN + program]
    return subprocess.run(
        command, env=environment | {"PYTHONPATH": path}, stdout=subprocess.PIPE, text=True, check=True, timeout=300
    ).stdout


def test_kinematic_analysis_needs_no_numba() -> None:
    program = """
from mechanism_fmu.kinematics import mobility
found = mobility(mechanism)
print(found.coordinates - found.nearby_rank, "numba" in sys.modules and sys.modules["numba"] is not None)
"""
    assert printed(program).split() == ["1", "False"]


def test_a_motion_is_refused_with_what_to_install() -> None:
    program = """
from mechanism_fmu.model import MechanismError
from mechanism_fmu.moving import MovingMechanism
from mechanism_fmu.simulation import Simulation
for begin in (Simulation, MovingMechanism):
    try:
        begin(mechanism)
    except MechanismError as error:
        print(error)
"""
    ahead, just_in_time = printed(program).splitlines()
    assert "sources have changed" in ahead
    assert "numba" in ahead
    assert ahead.endswith('python -m pip install -e ".[dev]"')
    assert "numba" in just_in_time
    assert "-e '.[dev]'" in just_in_time
