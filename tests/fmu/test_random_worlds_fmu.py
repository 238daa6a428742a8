"""Random worlds of outlines give the same bits in both flavours."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from mechanism_fmu.model import Mechanism
from tests.analytic.random_worlds import world
from tests.analytic.run_worlds import run

_FILE = '''"""A random world."""

from mechanism_fmu.model import (
    Body,
    CircularCopies,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Output,
    Revolute,
    Settings,
)


def mechanism(values):
    """All numbers are given."""
    return {mechanism}


MODEL = Model("RandomWorld", "Random world {seed}", (), mechanism, stop_time={until}, step_size=0.005)
'''


def as_text(made: Mechanism) -> str:
    """What makes the same mechanism again."""
    contacts = tuple(one for one in made.contacts if one.place == 0)
    outputs = tuple(one for one in made.outputs if not one.name.startswith("energy"))
    parts = f"{made.bodies!r}, {made.joints!r}, contacts={contacts!r}, outputs={outputs!r}"
    return f"Mechanism({parts}, gravity={made.gravity!r}, settings={made.settings!r})"


@pytest.mark.parametrize(
    "seed", [6, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (0, 1, 4, 7))]
)  # a wheel; a heap, a tumble, a pendulum, a slot
def test_both_flavours_agree_to_the_bit(seed: int, tmp_path: Path) -> None:
    made = world(seed)
    assert run(made).impacts > 0
    file = tmp_path / "random_world.py"
    file.write_text(_FILE.format(mechanism=as_text(made.mechanism), seed=seed, until=made.until), encoding="utf-8")
    found = []
    for flavour in ("pythonfmu", "native"):
        command = ["build", str(file), "-o", str(tmp_path / flavour), "--flavour", flavour]
        said = CliRunner().invoke(main, command)
        assert said.exit_code == 0, said.output
        fmu = next((tmp_path / flavour).glob("*.fmu"))
        found.append(fmpy.simulate_fmu(str(fmu), stop_time=made.until, output_interval=made.until / 200))
    first, second = found
    assert any(np.ptp(first[name]) > 0.0 for name in first.dtype.names if name != "time")
    np.testing.assert_array_equal(first, second)
