"""The examples of docs/explanation/elastodynamics-dynamics.md, in one file, print what stands below them."""

from pages import JOINTS, examples, what_prints

PAGE = JOINTS.parent / "explanation" / "elastodynamics-dynamics.md"


def test_examples_print_what_the_page_says():
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        assert what_prints(program, PAGE, names) == expected
