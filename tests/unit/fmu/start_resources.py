"""The resources of an FMU, reduced to what its start module touches, and that module as a new process has it."""

import shutil
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import mechanism_fmu.fmu.start as original

START = Path(original.__file__)

#: A package as an FMU carries it, reduced to what the start module touches.
SOURCES = {
    "__init__.py": "",
    "fmu/__init__.py": "",
    "fmu/instance/slave.py": "def make_slave_class(model):\n    return type(model, (), {'made_in': __file__})\n",
    "models/tiny.py": "MODEL = 'Tiny'\n",
}


def write_resources(folder: Path, digest: str, sources: dict[str, str] = SOURCES) -> Path:
    """The resources folder of an FMU."""
    for name, text in sources.items():
        path = folder / f"mechanism_fmu_{digest}" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    shutil.copy(START, folder / f"start_{digest}.py")
    (folder / "requirements.txt").write_text("numba>=0.68,<0.69\nnumpy>=2.0\n")
    return folder


Load = Callable[[Path, str], ModuleType]


def contents(folder: Path) -> dict[str, str]:
    return {
        p.relative_to(folder).as_posix(): p.read_text() for p in folder.rglob("*") if p.suffix != ".pyc" and p.is_file()
    }
