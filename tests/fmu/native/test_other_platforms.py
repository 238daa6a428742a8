"""The binaries for other platforms give the same bits there: with Windows' functions as wine has them, and on ARM."""

import os
import shutil
import sys
from pathlib import Path

import pytest

from mechanism_fmu.fmu.native.link import TARGETS
from tests.fmu.c_host import Host, Script, cross_compile_host
from tests.fmu.conformance.host import Instance
from tests.fmu.native.scenes import samples
from tests.fmu.native.test_c_host import check_everything, everything

UNTIL = 17.0
#: The C library for that processor, by Debian's package libc6-arm64-cross.
ARM = Path("/usr/aarch64-linux-gnu")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform != "linux", reason="wine and qemu are looked for on Linux"),
]


def zig(name):
    return next(target.zig for target in TARGETS if target.name == name)


@pytest.fixture(scope="module")
def windows(tmp_path_factory):
    if shutil.which("wine") is None:
        pytest.skip("wine is not installed")
    home = tmp_path_factory.mktemp("wine")
    environment = {"PATH": os.defpath, "HOME": str(home), "WINEPREFIX": f"{home}/prefix", "WINEDEBUG": "-all"}
    program = cross_compile_host(tmp_path_factory.mktemp("windows"), zig("x86_64-windows"))
    yield Host(program, ("wine",), environment), "binaries/win64/Ratchet.dll"
    shutil.rmtree(home, ignore_errors=True)  # 700 MB that pytest would keep


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    emulator = shutil.which("qemu-aarch64")
    if emulator is None or not ARM.is_dir():
        pytest.skip(f"qemu-aarch64 (Debian: qemu-user), or {ARM} (Debian: libc6-arm64-cross), is not installed")
    program = cross_compile_host(tmp_path_factory.mktemp("arm"), zig("aarch64-linux"))
    return Host(program, (emulator, "-L", str(ARM))), "binaries/aarch64-linux/Ratchet.so"


@pytest.fixture(params=["windows", "arm"])
def elsewhere(request):
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def here(native_ratchet):
    with Instance(native_ratchet) as one:
        return samples(one, until=UNTIL)


def test_the_indexing_cycle_is_the_same(elsewhere, native_ratchet, here, tmp_path):
    host, library = elsewhere
    script = Script(native_ratchet)
    samples(script, until=UNTIL)
    printed = host.run(native_ratchet, library, script, tmp_path)
    assert printed.code == 0, printed.log
    assert printed.numbers == here


def test_states_refusals_and_resets_work_there(elsewhere, native_ratchet, tmp_path):
    host, library = elsewhere
    check_everything(host.run(native_ratchet, library, everything(native_ratchet), tmp_path))
