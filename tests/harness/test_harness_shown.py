"""`show`: a model's page as an object that a notebook shows."""

import re
from html import unescape
from pathlib import Path

import pytest

import models
from harness.page.page_file import page
from harness.page.shown import Shown, show
from mechanism_fmu.fmu.native.link import has_linker
from mechanism_fmu.fmu.native.web import web_module
from mechanism_fmu.model import MechanismError


def test_a_page_shows_itself_in_a_frame_of_its_own(tmp_path: Path) -> None:
    html = '<p title="a & b">"quoted" &amp; <b>bold</b></p>'
    shown = Shown(html, height=300)
    frame = shown._repr_html_()
    (held,) = re.findall(r'srcdoc="([^"]*)"', frame)
    assert unescape(held) == html
    assert "height: 300px" in frame
    assert 'sandbox="allow-scripts allow-downloads"' in frame
    assert shown.save(tmp_path / "page.html").read_text(encoding="utf-8") == html
    assert repr(shown).startswith("Shown(0 kB")


@pytest.mark.skipif(not has_linker(), reason="ziglang is not installed")
def test_it_is_the_page_of_the_command() -> None:
    module = models.load("ratchet")
    shown = module.MODEL.show(height=400)
    assert shown == show(module.MODEL, height=400)
    assert (shown.html, shown.height) == (page(web_module(module)), 400)


def test_without_a_front_end_a_model_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.metadata.entry_points", lambda **_: ())
    with pytest.raises(MechanismError, match="Nothing that shows models is installed here; install the project again"):
        models.load("ratchet").MODEL.show()


def test_what_is_no_model_and_no_height_is_refused() -> None:
    with pytest.raises(ValueError, match="the height is 0 px"):
        show(models.load("ratchet").MODEL, height=0)
    with pytest.raises(MechanismError, match=r"^'ratchet' is no model; give the Model itself, such as models\.load"):
        show("ratchet")
    with pytest.raises(MechanismError, match=r"^the module models\.ratchet\S* is no model; give the Model itself"):
        show(models.load("ratchet"))
