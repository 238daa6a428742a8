"""The examples of docs/how-to/batch.md, which follow each other in one file, print what stands below them."""

import shutil

from pages import JOINTS, examples, what_prints

PAGE = JOINTS.parent / "how-to" / "batch.md"


def test_examples_print_what_the_page_says(ratchet_fmu, tmp_path, monkeypatch):
    (tmp_path / "build").mkdir()
    shutil.copy(ratchet_fmu, tmp_path / "build" / "Ratchet.fmu")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        assert what_prints(program, PAGE, names) == expected
    assert "swing" in names
