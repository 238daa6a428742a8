from collections.abc import Callable
from pathlib import Path

import pytest
from real_reports import Report, written_reports

import models
from harness.page.page_file import page
from mechanism_fmu.fmu.native.web import web_module
from mechanism_fmu.fmu.own.prepare import load
from tests.once import once

GALLERY = Path(__file__).parents[2] / "docs/examples/gallery"


@pytest.fixture(scope="session")
def reports(ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Report]:
    """One of each kind."""
    return written_reports(ratchet_fmu, tmp_path_factory.mktemp("reports"))


@pytest.fixture(scope="session")
def page_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The page of a model by its name."""

    def made(name: str) -> Path:
        def work(folder: Path) -> None:
            module = load(GALLERY / name) if name.endswith(".py") else models.load(name)
            (folder / "model.html").write_text(page(web_module(module)), encoding="utf-8")

        return once(tmp_path_factory, f"page_{name}", work) / "model.html"

    return made
