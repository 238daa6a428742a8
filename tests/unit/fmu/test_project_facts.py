from importlib import metadata
from pathlib import Path

import pytest

from mechanism_fmu.fmu.parts import documentation


def test_a_checkout_answers_for_itself() -> None:
    assert "numba<0.69,>=0.68" in documentation.dependencies()
    assert documentation.licence_text("mechanism_fmu").startswith("MIT License")


def test_an_installed_library_answers_from_its_metadata(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(documentation, "_PROJECT", Path("no such file"))
    monkeypatch.setattr(
        metadata, "requires", lambda _: ["rich>=13", "pytest>=8; extra == 'test'", 'numba>=0.68,<0.69; extra == "dev"']
    )
    assert documentation.dependencies() == ["rich>=13", "numba<0.69,>=0.68"]  # in the same order as from a checkout


def test_the_licence_of_another_distribution_is_read() -> None:
    assert "NTNU" in documentation.licence_text("pythonfmu")
