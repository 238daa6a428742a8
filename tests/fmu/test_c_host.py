"""The FMU in a host that is not Python."""

import math
import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

from tests.fmu.conformance.host import Fmu

COMPILER = shutil.which("cc") or shutil.which("gcc")
LIBPYTHON = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("INSTSONAME") or "none")

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or COMPILER is None or not (LIBPYTHON.is_file() and ".so" in LIBPYTHON.name),
    reason="needs Linux, a C compiler and a shared libpython",
)


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> Path:
    program = tmp_path_factory.mktemp("host") / "c_host"
    source = Path(__file__).with_name("c_host.c")
    subprocess.run([str(COMPILER), "-o", str(program), str(source), "-ldl"], check=True)
    return program


@pytest.fixture(scope="module")
def unzipped(ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("unzipped")
    zipfile.ZipFile(ratchet_fmu).extractall(folder)
    return folder


@pytest.mark.parametrize(("instances", "unload"), [(1, "never"), (3, "never"), (2, "end")])
def test_it_runs_and_leaves_in_peace(host: Path, unzipped: Path, ratchet: Fmu, instances: int, unload: str) -> None:
    environment = os.environ | {"LD_PRELOAD": str(LIBPYTHON), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    library = unzipped / "binaries" / "linux64" / "Ratchet.so"
    done = subprocess.run(
        [
            str(host),
            str(unzipped),
            str(library),
            str(instances),
            unload,
            str(ratchet.variables["wheel_angle"].valueReference),
        ],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    # pythonfmu's wrapper by itself ends every such host with an abort (see start.py).
    assert (done.returncode, done.stderr) == (0, "")
    # the wheel's angle has hardly moved from its start of 75 deg after 10 ms
    assert float(done.stdout) == pytest.approx(math.radians(75), abs=1e-6)
