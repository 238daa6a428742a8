"""Ready outlines: teeth of wheels, pallets of escapements, holes and hooks, by their usual dimensions.

An open one is one tooth of a wheel about the origin; `CircularCopies` of its number make the wheel. Its ends join those
of its neighbours where nothing touches, at the bottom between two teeth.
"""

from .escapements import (
    deadbeat_pallet as deadbeat_pallet,
    escape_tooth as escape_tooth,
    recoil_pallet as recoil_pallet,
)
from .gears import involute_tooth as involute_tooth, pin_tooth as pin_tooth
from .geneva import geneva_sector as geneva_sector
from .latches import hook as hook, round_hole as round_hole, slot_hole as slot_hole
from .ratchet import ratchet_tooth as ratchet_tooth
