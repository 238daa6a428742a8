"""Through a singular configuration: both flavours move and say the same, in states that are saved there, too."""

import re
from pathlib import Path

import pytest

import tests.flat_parallelogram as flat
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from tests.fmu.conformance.host import Fmu, Instance

SAID = re.compile(
    r"Singular configurations passed along the smooth branch in the step to t = (\S+) s: (\d+)(?:, the last one at t = "
    r"(\S+) s)?\."
)


def passes(one: Instance) -> list[tuple[str, ...]]:
    return [found.groups() for message in one.log if (found := SAID.fullmatch(message.text))]


@pytest.mark.parametrize("size", [0.01, 2.0])
def test_both_flavours_agree_to_the_bit(size: float, tmp_path: Path) -> None:
    seen = []
    for flavour, build in (("pythonfmu", build_fmu), ("native", build_native_fmu)):
        fmu = Fmu.unzip(build(flat, tmp_path / flavour), tmp_path / f"{flavour}_unzipped")
        with Instance(fmu) as one:
            one.begin()
            one.run(2.0, size)
            seen.append((passes(one), one.outputs()))
    (python, motion), native = seen
    assert native == (python, motion)
    assert sum(int(count) for _, count, _ in python) == 2
    assert motion["left_angle"] == pytest.approx(motion["right_angle"], abs=1e-9)
    if size < 1.0:
        assert [float(at) for _, _, at in python] == pytest.approx([0.70845, 1.215258], abs=1e-4)
