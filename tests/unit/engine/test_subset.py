"""What the engine is called with; what the compiled engine needs: see tests/fmu/native/test_subset.py."""

from mechanism_fmu import codes, moving
from mechanism_fmu.engine import run
from mechanism_fmu.model import Body, Mechanism
from mechanism_fmu.simulation import Simulation


def test_whole_numbers_of_seconds_compile_nothing_new(monkeypatch):
    """Python's integers are another type to the compiler, which would take its time for each combination."""
    given = []

    def watched(name, function):
        def call(*arguments):
            given.append((name, *(type(argument) for argument in arguments)))
            return function(*arguments)

        return call

    def engine_for(*block):
        return run.Engine(*map(watched, run.Engine._fields, run.engine_for(*block)))

    monkeypatch.setattr(moving, "engine_for", engine_for)
    for start, end in ((1.0, 2.0), (1, 2)):
        stone = Simulation(Mechanism(bodies=(Body("stone", 1.0, 1.0),)), start_time=start)
        stone.advance(end)
        stone.begin_step()
        stone.go_on(end + 1, codes.STOP_AT_TARGET)
    half = len(given) // 2
    assert given[:half] == given[half:]
    assert {name for name, *_ in given} >= {"begin", "advance", "begin_step", "go_on"}
    assert all(float in types for name, *types in given if name in ("begin", "advance", "go_on"))
