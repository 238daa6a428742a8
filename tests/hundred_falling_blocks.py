"""The hundred of `falling_blocks`: 200 contacts."""

from types import SimpleNamespace

from mechanism_fmu.model import Mechanism, Model
from tests.falling_blocks import blocks


def mechanism(values: SimpleNamespace) -> Mechanism:
    return blocks(100)


MODEL = Model("HundredFallingBlocks", "A hundred blocks that fall one after the other", (), mechanism)
