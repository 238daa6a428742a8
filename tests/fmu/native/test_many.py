"""Many instances at once, one after the other, and for long: the same numbers, and no memory lost.

`python -m benchmarks.endurance` does the same a hundred times as often.
"""

from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial

import pytest

from benchmarks import endurance, rattling
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.fmu.conformance.host import Fmu, Instance
from tests.fmu.native.scenes import cycle, paper, steps

THREADS = 8
#: An instance has 25 kB, and the allocator its own unrest.
GROWTH = 1e6

needs_proc = pytest.mark.skipif(endurance.memory() == 0, reason="needs /proc to see the memory of a process")


@pytest.fixture(scope="module")
def bare_ratchet(native_ratchet):
    return endurance.BareHost(native_ratchet.folder)


@pytest.fixture(scope="module")
def rattling_pawl(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rattling")
    return endurance.BareHost(Fmu.unzip(build_native_fmu(rattling, folder), folder / "unzipped").folder)


def test_eight_threads_do_what_each_does_alone(native_ratchet):
    scenes = [paper, partial(cycle, until=6.0)]
    expected = []
    for scene in scenes:
        with Instance(native_ratchet) as one:
            expected.append(steps(scene, one))

    with ExitStack() as stack:
        # Loaded one after the other: for that, fmpy changes the working directory of the whole process and back.
        instances = [stack.enter_context(Instance(native_ratchet, str(number))) for number in range(THREADS)]
        pool = stack.enter_context(ThreadPoolExecutor(THREADS))
        found = list(pool.map(lambda number: steps(scenes[number % 2], instances[number]), range(THREADS)))
    assert found == expected * (THREADS // 2)


def growth(operation, host, count, warm_up):
    operation(host, warm_up)
    before = endurance.memory()
    operation(host, count)
    return endurance.memory() - before


@needs_proc
def test_instances_that_come_and_go_leave_nothing(bare_ratchet):
    assert growth(endurance.live_and_die, bare_ratchet, 5000, 200) < GROWTH


@needs_proc
def test_a_hundred_thousand_steps_cost_no_memory(bare_ratchet):
    assert growth(endurance.index, bare_ratchet, 100_000, 10_000) < GROWTH


@needs_proc
def test_ten_thousand_impacts_cost_no_memory(rattling_pawl):
    assert growth(endurance.rattle, rattling_pawl, 10_000, 1000) < GROWTH


def test_what_rattles_without_loss_keeps_its_energy(rattling_pawl):
    """As far as its relative tolerance of 1e-9 goes, 4e-11 an impact."""
    assert abs(endurance.rattle(rattling_pawl, 10_000)) < 1e-6
