"""What could crash a host, each to be run in a process of its own by `run_alone`."""

from __future__ import annotations

import gc
import math
import random
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from ctypes import c_void_p
from functools import partial
from pathlib import Path

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks

from tests.fmu.conformance.host import Fmu, Instance

_ROOT = Path(__file__).parents[3]


def run_alone(function: Callable[..., None], *arguments: str) -> str:
    """Run a function of this module in a new process, and return what it prints.

    Raises:
        AssertionError: it has failed, crashed or hung.
    """
    program = f"import faulthandler, sys; faulthandler.enable(); from {__name__} import {function.__name__} as function"
    command = [sys.executable, "-c", f"{program}; function(*sys.argv[1:])", *arguments]
    done = subprocess.run(command, cwd=_ROOT, capture_output=True, text=True, timeout=180)
    assert done.returncode == 0, f"{function.__name__} ended with {done.returncode}:\n{done.stdout}\n{done.stderr}"
    return done.stdout


def refused(call: Callable[[], object]) -> bool:
    try:
        call()
    except FMICallException:
        return True
    return False


def refusals(folder: str) -> None:
    """Refusals of every kind, again and again; the instance goes on, is reset and is freed."""
    fmu = Fmu.at(folder)
    name = fmu.named("input")[0]
    with Instance(fmu) as one, Instance(fmu, "other") as other:
        for _ in range(20):
            assert refused(lambda: one.step(0.1))
            assert refused(lambda: one.set({name: math.nan}))
            assert refused(lambda: one.slave.getReal([10**6]))
            one.begin().step(0.1)
            assert refused(lambda: one.step(-1.0))
            assert refused(one.begin)
            assert refused(lambda: one.restore_bytes(b"no state", 0.0))
            one.step(0.1)
            one.reset()
        other.begin().step(0.1)


def odd_calls(folder: str) -> None:
    """Functions that are not supported, null pointers with zero sizes, the wrong GUID and type."""
    fmu = Fmu.at(folder)
    with Instance(fmu) as one:
        slave, component = one.slave, one.slave.component
        one.begin().step(0.01)
        unsupported = [
            slave.cancelStep,
            lambda: slave.getStatus(0),
            lambda: slave.getIntegerStatus(0),
            lambda: slave.getStringStatus(1),
            lambda: slave.getDirectionalDerivative([3], [0], [1.0]),
            lambda: slave.setRealInputDerivatives([0], [2], [1.0]),
            lambda: slave.getRealOutputDerivatives([3], [2]),
        ]
        interpolates = fmu.description.coSimulation.canInterpolateInputs
        if not interpolates:
            unsupported.append(lambda: slave.setRealInputDerivatives([0], [1], [0.0]))
        for call in unsupported:
            assert refused(call)
        for kind in ("Real", "Integer", "Boolean", "String"):
            for way in ("Get", "Set"):
                getattr(slave, f"fmi2{way}{kind}")(component, None, 0, None)
        slave.fmi2FreeFMUstate(component, c_void_p())
        slave.fmi2FreeInstance(None)
        assert slave.getTypesPlatform() == "default"
        assert slave.getVersion() == "2.0"
        one.step(0.01)
        assert slave.getRealStatus(2) == one.time

    other = FMU2Slave(
        guid="{wrong}",
        unzipDirectory=folder,
        modelIdentifier=fmu.description.coSimulation.modelIdentifier,
        instanceName="other",
    )
    # That pythonfmu's wrapper accepts another GUID is its own decision.
    assert instantiated(other) == fmu.description.coSimulation.needsExecutionTool


def instantiated(slave: FMU2Slave) -> bool:
    try:
        slave.instantiate(callbacks=defaultCallbacks)
    except Exception:
        return False
    slave.freeInstance()
    return True


def odd_names(folder: str) -> None:
    """Instance names that a logger's printf or a decoder could stumble over, through a native logger."""
    for name in ("100 %s %n %d", "Zahnrad ä 齿轮", "", "a" * 5000):
        with Instance(Fmu.at(folder), name, callbacks=defaultCallbacks) as one:
            one.begin()
            assert refused(partial(one.step, -1.0))
            one.reset().begin().step(0.01)


def random_calls(folder: str) -> None:
    """Thousands of calls in any order with any values; then every instance, reset, does the reference run."""
    fmu = Fmu.at(folder)
    dice = random.Random(20)
    numbers = [math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, -1.0, 0.0]
    integers = [-(2**31), 2**31 - 1, -1, 0, 1]
    references = [*range(len(fmu.description.modelVariables)), 10**6, 2**31, 2**32 - 1]
    settable = [v.name for v in fmu.description.modelVariables if v.causality in ("input", "parameter")]
    with Instance(fmu, "a") as a, Instance(fmu, "b") as b, Instance(fmu, "c", logging=False) as c:
        states: list[c_void_p] = []

        def call(one: Instance) -> None:
            slave = one.slave
            several = dice.choices(references, k=dice.randrange(4))
            kind = dice.choice(["Real", "Integer", "Boolean"])
            name = dice.choice(settable)
            match dice.randrange(16):
                case 0:
                    slave.setupExperiment(dice.choice([None, *numbers]), dice.choice([0.0, 0.0, *numbers]))
                case 1:
                    slave.enterInitializationMode()
                case 2:
                    slave.exitInitializationMode()
                case 3:
                    slave.terminate()
                case 4:
                    slave.reset()
                case 5:
                    getattr(slave, f"get{kind}")(several)
                case 6:
                    values = [dice.choice(numbers if kind == "Real" else integers) for _ in several]
                    getattr(slave, f"set{kind}")(several, values)
                case 7:
                    one.set({name: one.fmu.start(name)})
                case 8:
                    states.append(one.save())
                case 9 if states:
                    slave.setFMUstate(dice.choice(states))
                case 10 if states:
                    saved = bytearray(slave.serializeFMUstate(dice.choice(states)))
                    saved[dice.randrange(len(saved))] ^= dice.choice([0, 1, 128])
                    states.append(slave.deSerializeFMUstate(bytes(saved)))
                case 11 if len(states) > 20:
                    slave.freeFMUstate(states.pop(dice.randrange(len(states))))
                case 12:
                    slave.doStep(dice.choice(numbers), dice.choice(numbers))
                case 13:
                    one.reset().begin()
                case _:
                    slave.doStep(slave.getRealStatus(2), dice.choice([1e-3, 0.05]))

        refusals = sum(refused(lambda: call(dice.choice([a, b, c]))) for _ in range(2000))
        assert 250 < refusals < 1750, refusals
        for state in states:
            a.slave.freeFMUstate(state)
        found = []
        for one in (a, b, c):
            one.reset().begin().run(1.5, 0.05)
            found.append(one.outputs())
    with Instance(fmu) as fresh:
        fresh.begin().run(1.5, 0.05)
        assert found == [fresh.outputs()] * 3


def threads(folder: str) -> None:
    """Instances that are stepped at the same time, each in its own thread, do what they do alone."""
    fmu = Fmu.at(folder)

    def run(number: int) -> dict[str, float]:
        first = fmu.named("input")[0]
        with Instance(fmu, str(number)) as one:
            one.begin({first: one.fmu.start(first) * (1 + number / 4)})
            for _ in range(400):
                one.step(4e-3)
                one.outputs()
            assert refused(lambda: one.step(-1.0))
            return one.outputs()

    alone = [run(number) for number in range(4)]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(run, range(4))) == alone


def _growth(call: Callable[[], None]) -> float:
    """What 500 calls cost each [bytes]; objects that only point at each other are no leak, and go first."""
    gc.collect()
    before = _resident()
    for _ in range(500):
        call()
    gc.collect()
    return (_resident() - before) / 500


def _resident() -> int:
    """Memory of this process [bytes]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


def _least_growth(call: Callable[[], None], enough: float) -> float:
    """The least `_growth` of several [bytes]: the allocator comes to rest, a leak does not.

    The first one of less than `enough` ends the search: the least is not more.
    """
    found = _growth(call)
    for _ in range(2):
        if found < enough:
            break
        found = min(found, _growth(call))
    return found


def memory(folder: str, most: str) -> None:
    """Print the size of a saved state, and what saving, refusing and resetting cost each time [bytes].

    Less than `most` is not looked into further; of a refused state, its own size is not counted.
    """
    with Instance(Fmu.at(folder), logging=False) as one:
        one.begin().step(0.1)
        saved = one.save_bytes()
        print("size", len(saved))

        def save() -> None:
            one.restore_bytes(one.save_bytes(), 0.1)

        def refuse_step() -> None:
            assert refused(lambda: one.step(-1.0))

        def refuse_state() -> None:
            assert refused(lambda: one.restore_bytes(saved[:-1], 0.1))

        def reset() -> None:
            one.reset().begin()

        for call in (save, refuse_step, refuse_state, reset):
            for _ in range(100):
                call()
            enough = float(most) + (len(saved) if call is refuse_state else 0)
            print(call.__name__, _least_growth(call, enough))
