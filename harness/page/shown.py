"""A model's page inside a notebook, or wherever an object may show itself as HTML."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path
from types import ModuleType
from typing import Any

from mechanism_fmu.batch import MechanismError
from mechanism_fmu.fmu.native.web import web_model

from .page_file import page

_HEIGHT = 720


@dataclass(frozen=True)
class Shown:
    """A page in which a model's engine runs; a notebook shows it where it is the last value of a cell.

    Attributes:
        html: the page, as `mechanism-fmu page` writes it.
        height: of its frame in a notebook [px].
    """

    html: str
    height: int = _HEIGHT

    def _repr_html_(self) -> str:
        """The page in a frame of its own, which asks nothing of where it stands."""
        return (
            f'<iframe srcdoc="{escape(self.html)}" sandbox="allow-scripts allow-downloads" '
            f'style="width: 100%; height: {self.height}px; border: 1px solid #8884"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Shown({len(self.html) / 1e3:.0f} kB; a notebook shows it, save(path) writes it)"

    def save(self, path: Path | str) -> Path:
        """Write the page as a file.

        Args:
            path: of the file; its folder is there.

        Raises:
            OSError: it cannot be written.
        """
        Path(path).write_text(self.html, encoding="utf-8")
        return Path(path)


def show(model: Any, height: int = _HEIGHT) -> Shown:
    """A model as a page in which its engine runs: sliders, motion, curves, impacts.

    Where the engine's sources have changed since it was installed, the first one compiles it, in a minute or two, and
    says nothing meanwhile.

    Args:
        model: a `Model`, such as the `MODEL` of a notebook or of `models.load("ratchet")`.
        height: of its frame in a notebook [px].

    Raises:
        MechanismError: it is no model, it cannot be built or traced, or the engine is to be compiled and cannot be.
        ValueError: the height is not positive.
    """
    if not height > 0:
        raise ValueError(f"the height is {height} px; give a positive number.")
    if isinstance(model, ModuleType) or not hasattr(model, "build"):
        what = f"the module {model.__name__}" if isinstance(model, ModuleType) else repr(model)[:60]
        raise MechanismError(f"{what} is no model; give the Model itself, such as models.load('ratchet').MODEL.")
    return Shown(page(web_model(model)), height)
