"""The FMU on a platform for which it has no compiled engine: numba compiles it there, and the numbers are the same."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import sys
from tests.fmu.conformance.host import Fmu, Instance

with Instance(Fmu.at(sys.argv[1])) as one:
    one.begin({"restitution": 0.5}).run(3.0, 0.05)
    print({name: value.hex() if isinstance(value, float) else value for name, value in one.outputs().items()})
    print("numba" in sys.modules)
"""


@pytest.fixture
def run(ratchet, tmp_path):
    def outputs(folder):
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM, str(folder)],
            cwd=Path(__file__).parents[2],
            capture_output=True,
            text=True,
            timeout=300,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.splitlines()

    return outputs


@pytest.mark.slow
def test_without_its_library_it_compiles_and_gives_the_same_bits(ratchet, run, tmp_path, monkeypatch):
    # A cache of its own: the engine's files there are those of this FMU.
    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path / "cache"))
    without = tmp_path / "without"
    shutil.copytree(ratchet.folder, without)
    libraries = list(without.glob("resources/mechanism_fmu_*/engine/compiled/*"))
    assert libraries
    for library in libraries:
        library.unlink()

    compiled, ahead = run(without)
    assert ahead == "True"
    assert run(ratchet.folder) == [compiled, "False"]
