"""The container of fmu-manipulation-toolbox: an FMU of the same version around one FMU, run by FMPy.

It uses event mode where an FMU has it, as FMUs with a clock need; its own FMU does not show it.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

from tests.importers import in_fmpy
from tests.importers.asked import Asked
from tests.importers.tool import Tool, Values, package_missing, package_version

_MAKE = "from fmu_manipulation_toolbox.cli.fmucontainer import fmucontainer; fmucontainer()"


def run(asked: Asked) -> Values:
    fmu, folder = Path(asked.fmu), Path(asked.folder)
    (folder / "box.csv").write_text(f"rule;from_fmu;from_port;to_fmu;to_port\nFMU;{fmu.name};;;\n", encoding="utf-8")
    (folder / fmu.name).symlink_to(fmu)
    options = ["-fmu-directory", str(folder), "-container", f"box.csv:{asked.step!r}", "-fmi", str(asked.fmi)]
    subprocess.run([sys.executable, "-c", _MAKE, *options], check=True, stdout=sys.stderr)
    return in_fmpy.run(replace(asked, fmu=str(folder / "box.fmu"), event_mode=False))


TOOL = Tool(
    "container (fmu-manipulation-toolbox)",
    ("fmi2", "fmi3", "clocks", "pythonfmu"),
    run,
    lambda: package_missing("fmu-manipulation-toolbox", "fmu_manipulation_toolbox"),
    lambda: package_version("fmu-manipulation-toolbox"),
    "it decides by itself on event mode",
)
