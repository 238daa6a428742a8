"""Random calls and forged saved states against the C sources of native FMUs, under AddressSanitizer and UBSan.

    python -m tests.fuzz.native --calls 1000000 --states 100000 [--seed 1] [--model ratchet] [--fmi 2]

All models, in FMI 2.0, 3.0, and 3.0 with a clock; calls and states are those of all together. It needs Linux and gcc.
"""

from __future__ import annotations

import argparse
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from functools import cache
from pathlib import Path

import fmpy

import mechanism_fmu.fmu.native as native
import models
from mechanism_fmu.fmu.native.description3 import reports_impacts
from mechanism_fmu.fmu.native.formulas import formulas
from mechanism_fmu.fmu.native.link import SURFACE
from mechanism_fmu.fmu.native.model_source import model_source
from mechanism_fmu.fmu.native.objects import compiled_engine
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import compile_mechanism
from mechanism_fmu.model.trace import trace
from mechanism_fmu.tables.layout import pack

_FLAGS = (
    "-std=gnu11",
    "-g",
    "-ffp-contract=off",
    "-fno-omit-frame-pointer",
    "-fsanitize=address,undefined",
    "-fsanitize=float-cast-overflow",
    "-fno-sanitize-recover=all",
)
_C = Path(native.__file__).with_name("c")
_SURFACE = tuple(_C / file for file in SURFACE)
_STANDARD = Path(fmpy.__file__).with_name("c-code")
VERSIONS = (2, 3)


def can_run() -> bool:
    """Whether this machine has what the drivers need."""
    return sys.platform == "linux" and shutil.which("gcc") is not None


def has_clock(name: str) -> bool:
    """Whether a model has impacts, and so a form with a clock."""
    return reports_impacts(variables_of(models.load(name).MODEL))


def _compiled(source: Path, folder: Path, optimised: str) -> Path:
    """The object file of a C source."""
    engine = compiled_engine()
    path = folder / f"{source.stem}.o"
    headers = [f"-I{place}" for place in (_C, engine.headers, _STANDARD)]
    subprocess.run(["gcc", *_FLAGS, optimised, *headers, "-c", str(source), "-o", str(path)], check=True)
    return path


@cache
def _shared(folder: Path) -> list[Path]:
    """The object files that the drivers of all models have in common."""
    return [_compiled(source, folder, "-O1") for source in (Path(__file__).with_name("driver.c"), *_SURFACE)]


def driver(name: str, folder: Path, clocks: bool = False) -> Path:
    """The program that calls the FMU of a model at random, compiled into a folder."""
    model = models.load(name).MODEL
    block = pack(compile_mechanism(model.build(model.values())))
    source = folder / f"{name}{'_with_clock' if clocks else ''}.c"
    text = model_source(model, formulas(trace(model), block), "{fuzz}", bytes(range(16)), clocks)
    source.write_text(text, encoding="ascii")
    of_engine = compiled_engine().objects[f"{platform.machine().lower()}-linux"]
    program = source.with_suffix("")
    # A model's own source is data and one function of thousands of sums, which take long to optimise.
    inputs = [*_shared(folder), _compiled(source, folder, "-O0"), of_engine]
    subprocess.run(["gcc", *_FLAGS, *map(str, inputs), "-lm", "-o", str(program)], check=True)
    return program


def run(program: Path, fmi: int, seed: int, calls: int, states: int, *forged: str) -> Counter[str]:
    """Run a driver; what it counted.

    Raises:
        AssertionError: it did not end well, with what it printed.
    """
    command = [str(program), *map(str, (fmi, seed, calls, states)), *forged]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=3600)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout[-2000:]}\n{done.stderr[:8000]}"
    return Counter({key: int(value) for key, value in re.findall(r"(\w+) (\d+)", done.stdout)})


def main() -> None:
    """The long form."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--calls", type=int, default=1_000_000)
    parser.add_argument("--states", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", choices=list(models.available()))
    parser.add_argument("--fmi", type=int, choices=VERSIONS)
    asked = parser.parse_args()
    names = [asked.model] if asked.model else list(models.available())
    versions = [asked.fmi] if asked.fmi else list(VERSIONS)
    forms = [(name, fmi, False) for name in names for fmi in versions]
    forms += [(name, 3, True) for name in names if 3 in versions and has_clock(name)]
    total: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        program = cache(lambda name, clocks: driver(name, Path(folder), clocks))
        for name, fmi, clocks in forms:
            begun = time.perf_counter()
            calls, states = (-(-count // len(forms)) for count in (asked.calls, asked.states))
            counted = run(program(name, clocks), fmi, asked.seed, calls, states)
            total += counted
            form = f"{name}, FMI {fmi}{' with a clock' if clocks else ''}"
            print(f"{form}: {dict(counted)}, {time.perf_counter() - begun:.0f} s", flush=True)
    print(f"all: {dict(total)}; no finding")


if __name__ == "__main__":
    main()
