"""The two pictures of a model, beside the script that draws them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace


def rewrite(script: str, drawn: str, icon: Callable[[SimpleNamespace, Path], None], values: SimpleNamespace) -> None:
    """Write drawing.svg and model.png.

    Args:
        script: the model's drawing.py, in whose folder they are.
        drawn: the drawing, as SVG text.
        icon: draws the icon for parameter values, into a file.
        values: for the icon.

    Raises:
        ModuleNotFoundError: matplotlib is missing; the drawing is written before.
    """
    folder = Path(script).parent
    (folder / "drawing.svg").write_text(drawn, encoding="utf-8")
    icon(values, folder / "model.png")
