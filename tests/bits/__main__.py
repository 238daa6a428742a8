"""Compare this tree with a revision: every FMU in every form, and the files that commands write.

python -m tests.bits REVISION [--models ratchet four_bar] [--forms pythonfmu fmi2] [--no-commands]

Prints what differs; the exit code is 1 if anything does. All models in all forms take some ten minutes.
"""

from __future__ import annotations

import argparse
import io
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

import models
from tests.bits.files import contents

ROOT = Path(__file__).parents[2]

#: Options of build_fmu.py.
FORMS: Mapping[str, tuple[str, ...]] = {
    "pythonfmu": (),
    "fmi2": ("--flavour", "native"),
    "fmi3": ("--flavour", "native", "--fmi", "3"),
    "clocks": ("--flavour", "native", "--fmi", "3", "--clocks"),
}
#: Arguments of mechanism-fmu; FMUS is the folder of the native FMUs, and each gets a folder of its own for results.
COMMANDS: tuple[tuple[str, ...], ...] = (
    *(("run", f"FMUS/{name}", "--stop-time", "2") for name in ("Ratchet.fmu", "Geneva.fmu", "FourBar.fmu")),
    ("study", "ratchet"),
    ("sweep", "docs/examples/teeth.toml"),
    ("optimise", "docs/examples/best_tooth.toml"),
    ("ked", "four_bar_path_generator"),
    ("machine", "run", "docs/examples/geared_cam.toml"),
)
#: What is another one whenever a source is.
_IDENTITY = re.compile(rb'(guid|instantiationToken|generationDateAndTime|generationTool)="[^"]*"')


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.bits", description="Two revisions, compared to the bit.")
    parser.add_argument("revision", help="the old one, e.g. HEAD~1")
    parser.add_argument("--models", nargs="+", default=list(models.available()), choices=models.available())
    parser.add_argument("--forms", nargs="+", default=list(FORMS), choices=list(FORMS))
    parser.add_argument("--no-commands", action="store_true", help="FMUs only")
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="bits_") as temporary:
        old, place = Path(temporary, "tree"), Path(temporary)
        unpack(wanted.revision, old)
        different = 0
        for form in wanted.forms:
            for name in wanted.models:
                different += report(f"{name}, {form}", list(fmus_differ(old, name, form, place)))
        for number, command in enumerate(() if wanted.no_commands else COMMANDS):
            different += report(" ".join(command), list(files_differ(old, command, place / f"command{number}")))
    print(f"{different} differ." if different else "All equal, to the bit.")
    return 1 if different else 0


def report(what: str, differences: list[str]) -> bool:
    """Print what differs, or that nothing does."""
    print(f"{what}: {'equal' if not differences else ''}", *differences[:10], sep="\n    ", flush=True)
    if len(differences) > 10:
        print(f"    and {len(differences) - 10} more")
    return bool(differences)


def unpack(revision: str, folder: Path) -> None:
    """The files of a revision."""
    packed = subprocess.run(["git", "archive", revision], cwd=ROOT, capture_output=True, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
        archive.extractall(folder, filter="data")


def run(tree: Path, *arguments: str) -> str:
    """Run Python in a tree, as if it were installed; its message when it fails, else ""."""
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=tree,
        env=os.environ | {"PYTHONPATH": str(tree)},
        capture_output=True,
        text=True,
    )
    return (done.stderr.strip() or f"exit code {done.returncode}") if done.returncode else ""


def fmus_differ(old: Path, name: str, form: str, place: Path) -> Iterator[str]:
    """What differs between a model's FMUs of both trees: in the description, and in any value of two runs."""
    files, refusals = [], []
    for tree, which in ((old, "old"), (ROOT, "new")):
        folder = place / which / form / name
        refusals.append(run(tree, "build_fmu.py", name, *FORMS[form], "-o", str(folder)))
        for file in folder.glob("*.fmu"):
            trouble = run(ROOT, "-m", "tests.bits.record", str(file), str(folder / "values.npz"))
            if trouble:
                raise SystemExit(f"{file}: {trouble}")
            files.append(file)
    if any(refusals):
        yield from lines_differ("refusal to build", *refusals)
        if form != "clocks" or "no clock" not in refusals[0]:  # which what has no impacts cannot have
            yield f"nothing to compare: {refusals[0][:300]}"
        return
    descriptions = [_IDENTITY.sub(rb"", zipfile.ZipFile(file).read("modelDescription.xml")) for file in files]
    yield from lines_differ("modelDescription.xml", *(text.decode() for text in descriptions))
    before, after = (dict(np.load(file.parent / "values.npz", allow_pickle=False)) for file in files)
    for key in [key for key in before if key.endswith(": message")]:
        yield f"nothing to compare in the run with {key}: {before[key]}"
    for key in sorted(before.keys() | after.keys()):
        if key not in before or key not in after:
            yield f"{key}: in one of the two only"
        elif before[key].tobytes() != after[key].tobytes():
            yield f"{key}: {_first(before[key], after[key])}"


def _first(before: np.ndarray[Any, Any], after: np.ndarray[Any, Any]) -> str:
    if before.shape != after.shape or before.ndim == 0:
        return f"{str(before)[:300]} is now {str(after)[:300]}"
    row = next(k for k in range(len(before)) if before[k].tobytes() != after[k].tobytes())
    return f"row {row}, {before[row]!r} is now {after[row]!r}"


def files_differ(old: Path, command: tuple[str, ...], place: Path) -> Iterator[str]:
    """What differs between the files that a command writes in both trees."""
    found = []
    for tree, which in ((old, "old"), (ROOT, "new")):
        folder = place / which
        fmus = str(place.parent / which / "fmi2")
        words = [_fmu(word, Path(fmus)) if word.startswith("FMUS/") else word for word in command]
        trouble = run(tree, "-c", "from harness.cli import main; main()", *words, "-o", str(folder))
        found.append(contents(folder) | {"trouble": trouble.replace(str(folder), "FOLDER")})
    before, after = found
    if len(before) == 1:
        yield f"no file to compare: {before['trouble']}"
    for name in sorted(before.keys() | after.keys()):
        if name not in before or name not in after:
            yield f"{name}: by one of the two only"
        else:
            yield from lines_differ(name, before[name], after[name])


def _fmu(word: str, folder: Path) -> str:
    found = list(folder.glob(f"*/{Path(word).name}"))
    if not found:
        raise SystemExit(f"There is no {word}: build it as well, or give --no-commands.")
    return str(found[0])


def lines_differ(name: str, before: str, after: str) -> Iterator[str]:
    """The first line that differs."""
    for number, (old, new) in enumerate(zip_longest(before.splitlines(), after.splitlines()), start=1):
        if old != new:
            yield f"{name}, line {number}: {str(old)[:200]} is now {str(new)[:200]}"
            return


if __name__ == "__main__":
    sys.exit(main())
