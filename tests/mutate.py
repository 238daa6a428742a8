"""Would a wrong line be noticed? A sample of mutants of chosen files, each put to the tests that belong to it.

    python -m tests.mutate harness mechanism_fmu/stress --sample 100 --seed 1

Works in a copy of the tree, which goes afterwards. The tests of a file are those that import it, then those that import
what imports it, and so on. Those named after it or its folder are asked first, with the slow ones among them, then the
others, nearest first. `-- ARGUMENTS` are pytest's, e.g. `-- tests/harness/machine`, and take their place. What lives is
printed. See docs/project/how-it-is-tested.md.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path

from tests.mutants import Mutant, mutants

ROOT = Path(__file__).parents[1]
#: What is asked first, and then of what lives: so many files, nearest first.
_STAGES = (3, 9, 18)
#: A browser, other tools and whole models: they say little of a line, and take long.
_LEFT_OUT = ("browser", "phone", "test_house", "benchmark", "docs", "million", "fmu/", "example_files")
#: A marker and files: what pytest is asked.
Tests = tuple[str, ...]
_PACKAGES = ("harness", "mechanism_fmu", "models", "tests", "build_fmu")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; 1 when a mutant lives."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutate", description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="Python files or folders of them")
    parser.add_argument("--sample", type=int, metavar="N", help="so many of all mutants (default: all)")
    parser.add_argument("--part", default="1/1", metavar="K/N", help="the K-th of N parts, for as many processes")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--portions", type=int, metavar="N", help="ask the first N portions of tests only: quick")
    parser.add_argument(
        "--timeout", type=float, default=300.0, metavar="S", help="a mutant that takes longer is noticed"
    )
    given = list(sys.argv[1:] if arguments is None else arguments)
    own = given.index("--") if "--" in given else len(given)
    asked = parser.parse_args(given[:own])
    found = all_mutants(asked.files)
    chosen = found if asked.sample is None else random.Random(asked.seed).sample(found, min(asked.sample, len(found)))
    chosen.sort(key=lambda mutant: (mutant.path, mutant.begin))
    part, parts = map(int, asked.part.split("/"))
    chosen = chosen[part - 1 :: parts]
    print(f"{len(chosen)} of {len(found)} mutants.", flush=True)
    nearest = Nearest()
    alive = []
    with tempfile.TemporaryDirectory(prefix="mutants-") as place:
        copy = copied(Path(place))
        for number, mutant in enumerate(chosen, start=1):
            tests = [("not slow", *given[own + 1 :])] if own < len(given) else nearest.stages(mutant.path)
            began = time.monotonic()
            how = verdict(copy, mutant, tests[: asked.portions], asked.timeout)
            print(f"{number:4d} {how:8} {time.monotonic() - began:5.0f} s  {mutant}", flush=True)
            if how == "LIVES":
                alive.append(mutant)
    share = 100.0 * (1.0 - len(alive) / len(chosen)) if chosen else 100.0
    print(f"{len(chosen) - len(alive)} of {len(chosen)} noticed ({share:.0f} %).", *alive, sep="\n")
    return 1 if alive else 0


def all_mutants(places: Iterable[Path]) -> list[Mutant]:
    """The mutants of files and folders.

    Raises:
        SystemExit: there are none; a sample of nothing would say that all is well.
    """
    files = [file for place in places for file in (sorted(place.rglob("*.py")) if place.is_dir() else [place])]
    found = [mutant for file in files for mutant in mutants(file.resolve(), ROOT)]
    if not found:
        raise SystemExit("There is nothing to change in these files.")
    return found


def copied(place: Path) -> Path:
    """The project's files, without what git does not know."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, place / name)
    return place


def verdict(copy: Path, mutant: Mutant, stages: Sequence[Tests], timeout: float) -> str:
    """Whether tests notice a mutant: "noticed", "too long" or "LIVES"."""
    file = copy / mutant.path
    source = file.read_bytes()
    file.write_bytes(mutant.apply(source))
    try:
        for tests in stages:
            how = _run(copy, tests, timeout)
            if how == "too long":
                file.write_bytes(source)
                how = how if _run_unchanged(copy, tests, timeout) is None else None
                file.write_bytes(mutant.apply(source))
            if how is not None:
                return how
        return "LIVES"
    finally:
        file.write_bytes(source)


@cache
def _run_unchanged(copy: Path, tests: Tests, timeout: float) -> str | None:
    """Tests that take too long of themselves say nothing of a mutant."""
    return _run(copy, tests, timeout)


def _run(copy: Path, tests: Tests, timeout: float) -> str | None:
    options = ["-x", "-q", "-p", "no:cacheprovider", "--hypothesis-seed=0", "-m"]
    command = [sys.executable, "-m", "pytest", *options, *tests]
    environment = os.environ | {"PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "1"}
    with subprocess.Popen(
        command, cwd=copy, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    ) as process:
        try:
            return None if process.wait(timeout) in (0, 5) else "noticed"
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            return "too long"


class Nearest:
    """Test files by how far they are from a module, along imports."""

    def __init__(self) -> None:
        self._importers: Mapping[str, set[str]] = _importers()

    def stages(self, path: str) -> list[Tests]:
        """The tests of a source file in portions: those named after it, the slow ones of them, then the nearest."""
        module = _module(path)
        distance = {module: 0}
        queue = [module]
        for one in queue:
            for importer in sorted(self._importers.get(one, ())):
                if importer not in distance:
                    distance[importer] = distance[one] + 1
                    queue.append(importer)
        tests = [name for name in distance if name.rpartition(".")[2].startswith("test_")]
        files = [f"{name.replace('.', '/')}.py" for name in sorted(tests, key=lambda name: (distance[name], name))]
        files = [file for file in files if not any(part in file for part in _LEFT_OUT)]
        own, folders = Path(path).stem, Path(path).parts[1:-1]
        files.sort(
            key=lambda file: (not _named_after(file, own), not _named_after(file, *folders), not _akin(file, path))
        )
        ends = [0, *(min(end, len(files)) for end in _STAGES)]
        portions = [("not slow", *files[begin:end]) for begin, end in pairwise(ends) if begin < end]
        named = [file for file in files[: _STAGES[0]] if _named_after(file, own, *folders)]
        return [*portions[:1], ("slow", *named), *portions[1:]] if named else portions


def _named_after(test: str, *names: str) -> bool:
    return any(name in Path(test).stem.removeprefix("test_harness_") for name in names)


def _akin(test: str, path: str) -> bool:
    """Whether a test file lies in the folder of tests that mirrors the source's."""
    parts = Path(path).parts
    if parts[0] == "mechanism_fmu":
        return test.startswith(f"tests/unit/{parts[1]}")
    return test.startswith("/".join(("tests", *parts[:-1]))) or (len(parts) == 2 and test.startswith("tests/harness"))


def _importers() -> dict[str, set[str]]:
    """By module, those that import it."""
    found: dict[str, set[str]] = defaultdict(set)
    files = [file for package in _PACKAGES for file in ((ROOT / package).rglob("*.py"))]
    modules = {_module(file.relative_to(ROOT).as_posix()) for file in files}
    for file in files:
        path = file.relative_to(ROOT).as_posix()
        name = _module(path)
        package = name.split(".") if file.name == "__init__.py" else name.split(".")[:-1]
        for node in ast.walk(ast.parse(file.read_bytes())):
            if isinstance(node, ast.Import):
                wanted = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                start = package[: len(package) - node.level + 1] if node.level else []
                base = ".".join([*start, *([node.module] if node.module else [])])
                wanted = [base, *(f"{base}.{alias.name}" for alias in node.names)]
            else:
                continue
            beside = [".".join([*package, one]) for one in wanted]  # as pytest has it in folders without __init__.py
            for one in [*wanted, *beside]:
                if one in modules and one != name:
                    found[one].add(name)
    return found


def _module(path: str) -> str:
    return path.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


if __name__ == "__main__":
    sys.exit(main())
