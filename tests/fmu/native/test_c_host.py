"""The native FMU in a plain host in C: nothing of Python around it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fmu.c_host import COMPILER, Host, Script, compile_host
from tests.fmu.conformance.host import Instance
from tests.fmu.native.scenes import CYCLE, LASTING, cycle, paper, samples, steps

LIBRARY = {2: "binaries/linux64/Ratchet.so", 3: "binaries/x86_64-linux/Ratchet.so"}
SYSTEM = {"linux-vdso.so", "libc.so", "libm.so", "ld-linux-x86-64.so"}

pytestmark = pytest.mark.skipif(sys.platform != "linux" or COMPILER is None, reason="needs Linux and a C compiler")
needs_valgrind = pytest.mark.skipif(shutil.which("valgrind") is None, reason="valgrind is not installed")


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """The host for FMI 2.0 or 3.0."""
    folder = tmp_path_factory.mktemp("host")
    return {fmi: compile_host(folder, fmi) for fmi in LIBRARY}


@pytest.fixture(scope="module")
def python_cycle(ratchet):
    """All outputs of the whole cycle, every half second, by the FMU that runs in Python."""
    with Instance(ratchet) as one:
        return samples(one, ratchet.named("output"))


def test_a_whole_indexing_cycle_without_any_environment(program, native_ratchet, python_cycle, tmp_path):
    script = Script(native_ratchet)
    samples(script, native_ratchet.named("output"))
    printed = Host(program[2], environment={}).run(native_ratchet, LIBRARY[2], script, tmp_path)
    assert printed.code == 0, printed.log[-1]
    assert printed.numbers == pytest.approx(python_cycle, rel=1e-12, abs=1e-12)
    assert sum(" Event " in line for line in printed.log) > 50


def test_it_needs_the_systems_c_library_only(native_ratchet, ratchet3):
    for fmu, library in ((native_ratchet, LIBRARY[2]), (ratchet3, LIBRARY[3])):
        done = subprocess.run(["ldd", str(Path(fmu.folder, library))], capture_output=True, text=True, check=True)
        assert {
            re.split(r"\.\d|/", line.strip().removeprefix("/lib64/"))[0] for line in done.stdout.splitlines()
        } <= SYSTEM


def everything(fmu, steps=40):
    """A script of all that an instance can be asked for, and of much that it refuses."""
    script = Script(fmu).say("refused step 0.1", "refused make 1 {not_this}", "make 0")
    script.begin(CYCLE | {"restitution": 0.5}).say(f"step 0.02 {steps}")
    script.get(LASTING)
    script.say("save 0", "save 1", "copy 0", "refused cut 0", "refused spoil 0", f"step 0.02 {steps}")
    script.get(LASTING)
    script.say("restore 0", f"step 0.02 {steps}")
    script.get(LASTING)
    # another instance takes over where the first one was, and both go on in turns
    script.say("make 1").begin().say("step 0.1 3", "restore 1")
    for _ in range(4):
        script.say("make 1", f"step 0.02 {steps // 4}", "make 0", f"step 0.02 {steps // 4}")
    script.say("make 1").get(LASTING)
    script.say("save 1", "forget 1", "terminate", "refused step 0.1", "free", "make 0")
    script.say("refused step -1", "refused step nan", "refused step 0", "refused begin", "refused get r 99999")
    script.say("refused set r 1 nan", "refused set r 1 1e999", "refused set r 6 1", "refused get i 6")
    script.say("refused get r 0", "refused set r 0 1")
    script.say("forget 1", "reset", "refused step 0.1").begin({"restitution": 0.3}).say("step 0.01 100")
    script.get(LASTING)
    return script.say("forget 0", "free", "unload")


def check_everything(printed):
    assert printed.code == 0, "\n".join(printed.log)
    count = len(LASTING)
    parts = [printed.numbers[k : k + count] for k in range(0, len(printed.numbers), count)]
    first, later, replayed, other, again = parts
    assert first != later == replayed == other
    assert again[LASTING.index("impact_count")] > 0


@needs_valgrind
@pytest.mark.parametrize("fmi", LIBRARY)
def test_memory_is_neither_misused_nor_lost(request, program, fmi, tmp_path):
    fmu = request.getfixturevalue("native_ratchet" if fmi == 2 else "ratchet3")
    valgrind = ("valgrind", "--quiet", "--error-exitcode=9", "--leak-check=full", "--show-leak-kinds=all")
    host = Host(program[fmi], (*valgrind, "--errors-for-leak-kinds=all"), {"PATH": os.defpath})
    check_everything(host.run(fmu, LIBRARY[fmi], everything(fmu), tmp_path))


@needs_valgrind
def test_valgrind_sees_a_state_that_is_lost(program, native_ratchet, tmp_path):
    valgrind = ("valgrind", "--quiet", "--error-exitcode=9", "--leak-check=full")
    script = Script(native_ratchet).begin().say("step 0.1", "save 0", "forget 1", "copy 0", "free", "unload")
    host = Host(program[2], (*valgrind, "--errors-for-leak-kinds=all"), {"PATH": os.defpath})
    assert host.run(native_ratchet, LIBRARY[2], script, tmp_path).code == 9


@pytest.mark.parametrize("scene", [paper, cycle], ids=lambda scene: scene.__name__)
def test_fmi_3_returns_early_at_each_impact(program, native_ratchet, ratchet3, scene, tmp_path):
    """And ends where the uninterrupted steps of FMI 2.0 end."""
    with Instance(native_ratchet) as one:
        expected = steps(scene, one)
        last = one.get(LASTING)
    impacts = {time for step in expected for time in impact_times(step)}
    assert len(impacts) > 0

    script = Script(ratchet3)
    scene(script, lambda _: None)
    script.get(LASTING)
    printed = Host(program[3]).run(ratchet3, LIBRARY[3], script.say("early", "free"), tmp_path)
    assert printed.code == 0, printed.log[-1]
    *found, early = printed.numbers
    assert found == pytest.approx(list(map(float, last.values())), rel=1e-12, abs=1e-12)
    assert early == len(impacts)


def impact_times(outputs):
    """Of the events of a step that came with an impulse."""
    events = range(1, outputs["events_in_step"] + 1)
    return [outputs[f"events[{k}].time"] for k in events if outputs[f"events[{k}].impulse"] > 0]
