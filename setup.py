"""How a wheel is laid out; everything else of the project is in pyproject.toml.

In the tree and in an editable install, `harness`, `models` and `build_fmu` are importable by these names. At the root
of site-packages they would hide, or be hidden by, what others call so. A wheel therefore holds them below
`mechanism_fmu` (docs/decisions/037-one-name-in-site-packages.md): moved when it is built, with the imports between them
written anew.
"""

from __future__ import annotations

import ast
import importlib.util
import os
import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py
from setuptools.errors import SetupError

_ROOT = Path(__file__).resolve().parent

#: The one name at the root of site-packages, and what a wheel has below it.
NAME = "mechanism_fmu"
MOVED = ("harness", "models", "build_fmu")

#: What compiles and links the engine that a wheel carries; backend/engine_backend.py asks for them.
COMPILERS = ("numba", "ziglang")

#: What the commands read beside packages, at the same place from the root of the tree as from `NAME` in a wheel.
BESIDE = ("docs/examples/*.*", "docs/examples/gallery/*.py", "docs/joints/*.svg")


def relocated(source: str, where: str) -> str:
    """A module's source with its imports of what moves as they are in a wheel.

    Args:
        source: of the module.
        where: its path, for messages.

    Raises:
        SetupError: an import of what moves that binds no single name, or is laid out otherwise than by ruff.
    """
    lines = source.split("\n")
    for node in ast.walk(ast.parse(source, where)):
        match node:
            case ast.ImportFrom(module=str(module), level=0) if _moves(module):
                old, new = f"from {module} import ", f"from {NAME}.{module} import "
            case ast.Import(names=[ast.alias(name=module)]) if module in MOVED:
                old, new = f"import {module}", f"from {NAME} import {module}"
            case ast.Import(names=names) if any(_moves(alias.name) for alias in names):
                old, new = "", ""
            case _:
                continue
        line, start = lines[node.lineno - 1], node.col_offset
        if not old or not line.startswith(old, start):
            raise SetupError(
                f"{where}, line {node.lineno}: {line.strip()!r} cannot be written anew for a wheel; write 'from ... "
                "import ...', or one 'import NAME' on a line, as ruff lays them out."
            )
        lines[node.lineno - 1] = line[:start] + new + line[start + len(old) :]
    return "\n".join(lines)


def _moves(module: str) -> bool:
    return module.partition(".")[0] in MOVED


class BuildPy(build_py):
    """Collects the modules of a wheel."""

    def run(self) -> None:
        """Collect them below `NAME`; for an editable install there is nothing to collect."""
        if self.editable_mode:
            return
        built = Path(self.build_lib).resolve()
        if built == _ROOT:
            raise SetupError(f"--build-lib {self.build_lib} is the source tree itself; choose another folder.")
        for name in (NAME, *MOVED):  # what an earlier build has left would get into this wheel
            _remove(built / name)
            _remove(built / f"{name}.py")
        super().run()
        package = built / NAME
        for name in MOVED:
            found = next(path for path in (built / name, built / f"{name}.py") if path.exists())
            found.rename(package / found.name)
        for pattern in BESIDE:
            for path in _ROOT.glob(pattern):
                target = package / path.relative_to(_ROOT)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, target)
        for path in package.rglob("*.py"):
            before = path.read_text(encoding="utf-8")
            after = relocated(before, str(path))
            if after != before:
                path.write_text(after, encoding="utf-8", newline="\n")
        tree = runpy.run_path(str(_ROOT / NAME / "fmu" / "native" / "sources.py"))
        if tree["is_compiled"](_ROOT / NAME):  # compiled by an editable install
            shutil.copytree(_ROOT / NAME / tree["COMPILED"], package / tree["COMPILED"], dirs_exist_ok=True)
        write_engine(built, package)
        for folder in list(package.rglob("__pycache__")):  # of the process that has compiled it
            _remove(folder)


class BdistWheel(bdist_wheel):
    """Says of a wheel what it puts at the root of site-packages."""

    def write_wheelfile(self, wheelfile_base: str, *args: str, **options: str) -> None:
        """Add the file WHEEL, and correct top_level.txt and entry_points.txt, which are written of the tree."""
        super().write_wheelfile(wheelfile_base, *args, **options)
        folder = Path(wheelfile_base)
        if folder.parent == Path(self.bdist_dir):  # an editable install has its own elsewhere
            (folder / "top_level.txt").write_text(f"{NAME}\n", encoding="utf-8")
            entries = folder / "entry_points.txt"
            entries.write_text(moved_entries(entries.read_text(encoding="utf-8")), encoding="utf-8")


def moved_entries(text: str) -> str:
    """Entry points with the modules that move where they are in a wheel."""
    return re.sub(rf"^(\S+ = )(?=({'|'.join(MOVED)})[.:])", rf"\1{NAME}.", text, flags=re.MULTILINE)


def write_engine(packages: Path, library: Path) -> None:
    """Put the compiled engine of a library into it: minutes, unless it is there, or the user's cache has it.

    Args:
        packages: the folder that `library` is imported from.
        library: the folder `mechanism_fmu`.

    Raises:
        SetupError: what compiles it is not installed, or refuses.
    """
    sources = runpy.run_path(str(library / "fmu" / "native" / "sources.py"))
    if sources["is_compiled"](library):
        return
    missing = [name for name in COMPILERS if importlib.util.find_spec(name) is None]
    if missing:
        raise SetupError(
            f"The engine is compiled with {' and '.join(missing)}, not installed here: build the wheel without "
            "--no-build-isolation, or install them first: python -m pip install -e '.[dev]'"
        )
    print("compiling the engine for all platforms; without an earlier one in the cache, minutes")
    program = (
        "import sys; from pathlib import Path; from mechanism_fmu.fmu.native.objects import write_engine; "
        "write_engine(Path(sys.argv[1]))"
    )
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join([str(packages), os.environ.get("PYTHONPATH", "")]),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, "-P", "-c", program, str(library / sources["COMPILED"])]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SetupError(f"The engine could not be compiled:\n{done.stderr.strip()}")


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


if __name__ == "__main__":  # so that a test can import `relocated`
    setup(cmdclass={"build_py": BuildPy, "bdist_wheel": BdistWheel})
