"""Files of sweeps: a good one, and what is said of one with mistakes."""

from pathlib import Path

import pytest
from fake_slave import fake_description

from harness.designs.sweep import Sweep, read_sweep
from harness.designs.variation import source
from harness.errors import UsageError
from harness.fmu.description import Description
from harness.toml_file import TomlFile

GOOD = """\
title = "Teeth"

[fmu]
file = "Fake.fmu"

[run]
stop_time = "500 ms"
step = 0.1

[set]
drive_torque = "2 N.m"
guided = false

[sweep]
method = "latin_hypercube"
count = 8
seed = 1

[vary.tooth_count]
from = 10
to = 25

[vary.tooth_slope_angle]
from = 85
to = 105
unit = "deg"

[vary.gear]
values = [1, 3]

[record]
end = ["wheel_angle"]
max = ["wheel_angle", "impact_count"]
first_impact = ["time"]
parameter = ["tooth_pitch"]
"""


def read(folder: Path, text: str, description: Description | None = None) -> Sweep:
    path = folder / "teeth.toml"
    path.write_text(text, encoding="utf-8")
    file = TomlFile.read(path)
    source(file)
    return read_sweep(file, description or fake_description())


def mistakes(folder: Path, text: str, description: Description | None = None) -> list[str]:
    """The lines that a file is answered with, without its path and the last stop."""
    with pytest.raises(UsageError) as error:
        read(folder, text, description)
    plain = str(error.value).replace(f"{folder}/teeth.toml:", "").replace(f"{folder}/", "")
    return [line.strip(" .") for line in plain.splitlines()]
