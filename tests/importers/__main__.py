"""Run the matrix, print it, and write it into the page.

python -m tests.importers [--models ratchet four_bar] [--keep FOLDER] [--no-page]
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from datetime import date
from pathlib import Path

import models
from tests.importers.forms import FORMS, Form
from tests.importers.matrix import matrix
from tests.importers.table import PAGE, put_in, table
from tests.importers.tools import TOOLS


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.importers", description="FMUs in other tools.")
    parser.add_argument("--models", nargs="+", default=list(models.available()), choices=models.available())
    parser.add_argument("--keep", type=Path, help="Folder of FMUs that stay, for another run of the same version.")
    parser.add_argument("--no-page", action="store_true", help="Do not write the table into the page.")
    wanted = parser.parse_args()
    for tool in TOOLS.values():
        print(f"{tool.name}: {tool.missing() or tool.version()}")
    with tempfile.TemporaryDirectory(prefix="importers_") as temporary:
        kept = (wanted.keep or Path(temporary, "built")).resolve()
        cells = []
        for cell in matrix(wanted.models, lambda name, form: fmu_of(name, form, kept), Path(temporary)):
            cells.append(cell)
            title = f"{TOOLS[cell.tool].name}, {FORMS[cell.form].title}"
            if cell.deviation is not None:
                print(f"{title}: {cell.deviation:.1e}", *cell.trouble, sep="\n  ", flush=True)
    lines = table(cells, len(wanted.models), date.today())
    print(f"\n{lines}")
    if not wanted.no_page:
        PAGE.write_text(put_in(PAGE.read_text(encoding="utf-8"), lines), encoding="utf-8")
    return 1 if any(cell.trouble for cell in cells) else 0


def fmu_of(name: str, form: Form, folder: Path) -> Path:
    """The file of a model in a form, built unless it is there."""
    place = folder / "_".join([form.build.__name__, *(f"{key}{value}" for key, value in form.options.items()), name])
    found = list(place.glob("*.fmu"))
    return found[0] if found else form.build(models.load(name), place, **form.options)


if __name__ == "__main__":
    sys.exit(main())
