"""The examples of docs/how-to/batch.md, which follow each other in one file, print what stands below them."""

import contextlib
import io
import shutil

from pages import JOINTS, examples

PAGE = JOINTS.parent / "how-to" / "batch.md"


def test_examples_print_what_the_page_says(ratchet_fmu, tmp_path, monkeypatch):
    (tmp_path / "build").mkdir()
    shutil.copy(ratchet_fmu, tmp_path / "build" / "Ratchet.fmu")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(program, PAGE.name, "exec"), names)
        assert printed.getvalue() == expected
    assert "swing" in names
