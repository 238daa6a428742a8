"""A run of the ratchet that is kept as a table, played to whoever asks: its reports need no engine.

    python -m tests.replayed

records it anew from the model, with what the FMU says of itself; the kept pages change with it (tests/kept.py).
"""

from __future__ import annotations

import json
import math
import shutil
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from harness.errors import FmuError, LogMessage, Status
from harness.fmu import open_fmu
from harness.fmu.description import Description, Value
from harness.fmu.description_file import read_description
from harness.fmu.interface import Observable
from harness.run.experiment import Experiment
from harness.run.master import TimeGrid, run_fixed_step

FOLDER = Path(__file__).parent / "data" / "replayed"
#: Long enough for three impacts.
EXPERIMENT = Experiment(
    1.2, 0.02, {"restitution": 0.3, "drive_torque": 2e-3, "guided": False, "holding_pawl": True, "tooth_count": 12}
)


class Replayed:
    """The instance: every variable has the value that it had, whatever is set."""

    def __init__(self, description: Description, fail: float = math.inf) -> None:
        self.description = description
        self.messages: list[LogMessage] = []
        held = json.loads((FOLDER / "values.json").read_text(encoding="utf-8"))
        self._still: dict[str, Value] = held["still"]
        self._moving: dict[str, list[Value]] = held["moving"]
        self._row = 0
        self._fail = fail

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.messages.append(LogMessage("Ratchet", start_time, Status.OK, "", "ready"))

    def set(self, values: Mapping[str, Value]) -> None:
        assert all(value == self._still.get(name, value) for name, value in values.items())

    def get(self, names: Sequence[str]) -> list[Value]:
        return [self._moving[name][self._row] if name in self._moving else self._still[name] for name in names]

    def step(self, time: float, size: float) -> None:
        if time + size > self._fail:
            self.messages.append(LogMessage("Ratchet", time, Status.WARNING, "", "the pawl <creaks>"))
            raise FmuError(f"the pawl broke at {time:g} s", time=time, status=Status.ERROR)
        self._row += 1

    def save(self, state: int | None = None) -> int:
        return self._row

    def restore(self, state: int) -> None:
        self._row = state

    def free_state(self, state: int) -> None:
        pass

    def terminate(self) -> None:
        pass


class ReplayedFmu:
    """The FMU whose only instance is `Replayed`."""

    path = Path("Ratchet.fmu")
    folder = FOLDER

    def __init__(self, fail: float = math.inf) -> None:
        self.description = read_description(FOLDER / "Ratchet.zip")
        self._fail = fail

    @contextmanager
    def instantiate(self, name: str, on_message: Callable[[LogMessage], None]) -> Iterator[Replayed]:
        yield Replayed(self.description, self._fail)


class _All:
    """An observer that keeps every variable."""

    def __init__(self) -> None:
        self.rows: list[dict[str, Value]] = []

    def started(self, unit: Observable, time: float) -> None:
        names = list(unit.description.variables)
        self.rows.append(dict(zip(names, unit.get(names), strict=True)))

    stepped = started


def record() -> None:
    """Run the ratchet, and keep it."""
    import models
    from mechanism_fmu.fmu.native.package import build_native_fmu

    with tempfile.TemporaryDirectory() as place, open_fmu(build_native_fmu(models.load("ratchet"), Path(place))) as fmu:
        for file in ("logic.json", "drawing.json"):
            shutil.copyfile(fmu.folder / "resources" / file, FOLDER / "resources" / file)
        with zipfile.ZipFile(FOLDER / "Ratchet.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            text = (fmu.folder / "modelDescription.xml").read_text(encoding="utf-8")
            archive.writestr(zipfile.ZipInfo("modelDescription.xml"), text, zipfile.ZIP_DEFLATED)
            declared = (fmu.folder / "resources" / "analysis.json").read_bytes()
            archive.writestr(zipfile.ZipInfo("resources/analysis.json"), declared, zipfile.ZIP_DEFLATED)
        kept = _All()
        with fmu.instantiate("Ratchet", lambda message: print(message.text)) as slave:
            grid = TimeGrid.of(EXPERIMENT.stop_time, EXPERIMENT.step)
            outcome = run_fixed_step(slave, grid, EXPERIMENT.start_values, [kept])
        print(outcome, kept.rows[-1]["impact_count"], "impacts")
    columns = {name: [row[name] for row in kept.rows] for name in kept.rows[0]}
    still = {name: values[0] for name, values in columns.items() if len(set(values)) == 1}
    moving = {name: values for name, values in columns.items() if name not in still}
    lines = ",\n".join(f" {json.dumps(name)}: {json.dumps(values)}" for name, values in moving.items())
    text = f'{{"still": {json.dumps(still)},\n"moving": {{\n{lines}\n}}}}\n'
    (FOLDER / "values.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(record())
