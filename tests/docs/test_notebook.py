"""The notebook runs from its first cell to its last, prints what it has kept, and shows the model's page."""

from pathlib import Path

import pytest

from docs.site.notebook import TUTORIAL, markdown, printed, read, run
from mechanism_fmu.fmu.native.link import has_linker


@pytest.mark.slow
@pytest.mark.skipif(not has_linker(), reason="ziglang is not installed")
def test_the_notebook_runs_and_prints_what_it_has_kept(tmp_path: Path) -> None:
    """It builds two FMUs and a page."""
    values = []
    for cell, text, value in run(read(TUTORIAL), tmp_path):
        assert text == printed(cell), "python -m docs.site.notebook"
        values.append(value)
    (shown,) = [value for value in values if value is not None]
    html = shown._repr_html_()
    assert html.startswith("<iframe srcdoc=")
    assert "A hammer on a compliant shaft" in html
    saved = shown.save(tmp_path / "hammer.html")
    assert saved.read_text(encoding="utf-8") == shown.html


def test_a_notebook_becomes_a_page() -> None:
    text = markdown(TUTORIAL)
    assert text.startswith("# From a mechanism to a machine\n\nA hammer")
    assert '\n`hammer.py`:\n\n```python\n"""A hammer' in text
    assert "\n```sh\nmechanism-fmu check hammer.py" in text
    assert "%%" not in text
