"""The FMU by pythonfmu in a host that is not Python."""

import math
import os
import sys
import sysconfig
from pathlib import Path

import pytest

from tests.fmu.c_host import COMPILER, Host, Script, compile_host
from tests.fmu.conformance.host import Fmu

LIBPYTHON = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("INSTSONAME") or "none")

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or COMPILER is None or not (LIBPYTHON.is_file() and ".so" in LIBPYTHON.name),
    reason="needs Linux, a C compiler and a shared libpython",
)


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> Host:
    environment = os.environ | {"LD_PRELOAD": str(LIBPYTHON), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    return Host(compile_host(tmp_path_factory.mktemp("host")), environment=environment)


@pytest.mark.parametrize(("instances", "unload"), [(1, False), (3, False), (2, True)])
def test_it_runs_and_leaves_in_peace(host: Host, ratchet: Fmu, tmp_path: Path, instances: int, unload: bool) -> None:
    script = Script(ratchet).say(*["free", "make 0"] * (instances - 1)).begin().say("step 1e-3 10")
    script.get(["wheel_angle"])
    script.say("free", *["unload"] * unload)
    printed = host.run(ratchet, "binaries/linux64/Ratchet.so", script, tmp_path)
    # pythonfmu's wrapper by itself ends every such host with an abort (see start.py).
    assert (printed.code, printed.log) == (0, [])
    # the wheel's angle has hardly moved from its start of 75 deg after 10 ms
    assert printed.numbers == [pytest.approx(math.radians(75), abs=1e-6)]
