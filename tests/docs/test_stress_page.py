"""The examples of docs/stress.md, which follow each other in one file, print what stands below them."""

import contextlib
import io

from pages import JOINTS, examples

from mechanism_fmu.stress import CARDS

PAGE = JOINTS.parent / "stress.md"


def test_examples_print_what_the_page_says():
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(program, PAGE.name, "exec"), names)
        assert printed.getvalue() == expected
    assert "result" in names


def test_table_of_materials_is_that_of_the_cards():
    text = PAGE.read_text(encoding="utf-8")
    for card in CARDS.values():
        s = card.strength
        numbers = [card.material.youngs_modulus / 1e9]
        numbers += [value / 1e6 for value in (s.yield_strength, s.tensile_strength, s.fatigue_coefficient)]
        exponent = f"{s.fatigue_exponent}".replace("-", "−")
        assert f"| `{card.name}` | {' | '.join(f'{n:.0f}' for n in numbers)} | {exponent} | " in text
        assert card.material.density == 7850.0
        assert card.material.damping_ratio == 0.03
