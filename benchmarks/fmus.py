"""The two FMUs that are compared: Ratchet.fmu, and the plain ratchet packed by pythonfmu."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from mechanism_fmu.fmu.disk.archive import content_hash

ROOT = Path(__file__).parents[1]

#: Modules of the plain ratchet that travel.
_PLAIN = ("__init__", "ratchet", "curve_file", "reference", "plain", "plain_slave")

#: Its slave file. What pythonfmu's wrapper does wrong would end the process of the benchmarks, too, with an abort.
_SLAVE = """from {package}.plain_slave import PlainRatchet

from mechanism_fmu.fmu.start import tidy_up

tidy_up(globals())
"""


def build_ratchet(folder: Path) -> Path:
    """Build Ratchet.fmu, with the compiled engine inside where ziglang is installed."""
    _run("-m", "build_fmu", "ratchet", "-o", str(folder))
    return folder / "Ratchet.fmu"


def build_plain(folder: Path) -> Path:
    """Build PlainRatchet.fmu: the same steps by `benchmarks.reference`."""
    files = {f"{name}.py": Path(__file__).with_name(f"{name}.py").read_bytes() for name in _PLAIN}
    digest = content_hash(files)[:12]  # module names that no other FMU in the process has
    package = folder / "plain" / f"plain_ratchet_{digest}"
    package.mkdir(parents=True)
    for name, contents in files.items():
        (package / name).write_bytes(contents)
    script = package.parent / f"PlainRatchet_{digest}.py"
    script.write_text(_SLAVE.format(package=package.name), encoding="utf-8")
    _run("-m", "pythonfmu", "build", "-f", str(script), "-d", str(folder), str(package))
    return folder / "PlainRatchet.fmu"


def _run(*arguments: str) -> None:
    subprocess.run([sys.executable, *arguments], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
