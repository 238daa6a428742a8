"""The examples of docs/explanation/stress.md, which follow each other in one file, print what stands below them."""

import math
import re

from pages import JOINTS, examples, what_prints

from mechanism_fmu.stress import (
    CARDS,
    STEEL,
    ModeScaling,
    RectangularTooth,
    TrapezoidTooth,
    WedgeTooth,
    maximum_stress,
    natural_modes,
)

PAGE = JOINTS.parent / "explanation" / "stress.md"


def test_examples_print_what_the_page_says():
    names: dict[str, object] = {}
    for program, expected in examples(PAGE):
        assert what_prints(program, PAGE, names) == expected
    assert "result" in names


def test_table_of_materials_is_that_of_the_cards():
    text = PAGE.read_text(encoding="utf-8")
    assert len(CARDS) > 2
    for card in CARDS.values():
        s = card.strength
        numbers = [card.material.youngs_modulus / 1e9]
        numbers += [value / 1e6 for value in (s.yield_strength, s.tensile_strength, s.fatigue_coefficient)]
        exponent = f"{s.fatigue_exponent}".replace("-", "−")
        assert f"| `{card.name}` | {' | '.join(f'{n:.0f}' for n in numbers)} | {exponent} | " in text
        assert card.material.density == 7850.0
        assert card.material.damping_ratio == 0.03


def test_table_of_convergence_is_what_the_modes_give():
    rows = re.findall(r"^\| (\**\d+\**) \| (\S+) \| (\S+) \| (\S+) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(rows) == 5
    teeth = WedgeTooth(1.0, math.pi / 4), TrapezoidTooth(1.0, 1.0, 0.2), RectangularTooth(1.0, 1.0)
    for row in rows:
        count, *printed = (cell.strip("*") for cell in row)
        n = int(count)
        for tooth, number in zip(teeth, printed, strict=True):
            modes = natural_modes(tooth, STEEL, min(2 * n, 60), scaling=ModeScaling.PROJECTION)[:n]
            assert f"{maximum_stress(tooth, STEEL, 1.0, modes).coefficient:.6f}" == number
