"""`page`: a model as one HTML file in which its engine runs."""

from __future__ import annotations

from pathlib import Path

import build_fmu

from ...page.page_file import page
from ...run.results import prepare_folder, write_text
from ..terminal import show_files


def write_page(model: str, output: Path | None) -> int:
    """Write the page of a model, ready-made or of a file of the user's own."""
    output = Path(f"{Path(model).stem}.html") if output is None else output
    prepare_folder(output.parent)
    web = build_fmu.web(model)
    text = page(web)
    show_files([write_text(output, lambda file: file.write(text))])
    return 0
