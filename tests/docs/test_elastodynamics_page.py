"""The examples of docs/explanation/elastodynamics.md print what stands below them."""

from pages import JOINTS, examples, what_prints

PAGE = JOINTS.parent / "explanation" / "elastodynamics.md"


def test_examples_print_what_the_page_says():
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        assert what_prints(program, PAGE, names) == expected
    assert "torque" in names
