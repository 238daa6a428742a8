"""The examples of docs/how-to/simulation.md, which follow each other in one file, print what stands below them."""

import contextlib
import io

from pages import JOINTS, examples

PAGE = JOINTS.parent / "how-to" / "simulation.md"


def test_examples_print_what_the_page_says() -> None:
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(program, PAGE.name, "exec"), names)
        assert printed.getvalue() == expected
    assert "simulation" in names
