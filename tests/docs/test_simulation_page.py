"""The examples of docs/how-to/simulation.md, which follow each other in one file, print what stands below them."""

from pages import JOINTS, examples, what_prints

PAGE = JOINTS.parent / "how-to" / "simulation.md"


def test_examples_print_what_the_page_says() -> None:
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        assert what_prints(program, PAGE, names) == expected
    assert "simulation" in names
