"""A blow on a tapered lever: bending, shear, pressure at the tip, stress along it, and how many blows a hole bears.

    python docs/examples/blow_on_a_lever.py

`mechanism-fmu run` says what bending each impact of an FMU leaves, of a beam that its model declares
(docs/tutorials/your-first-mechanism.md). This goes on from there, with what no FMU knows: how long the contact lasts,
how round the tip is, how sharp a notch. Formulas and their limits: docs/explanation/stress.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mechanism_fmu.stress import (
    LineContact,
    MaterialCard,
    MeanStress,
    Ringing,
    SectionBeam,
    TableBeam,
    axial_stress,
    converged_modes,
    hertz_line_contact,
    material_card,
    maximum_stress,
    miner_damage,
    peak_force,
    rainflow_cycles,
    shear_force,
    shear_stress,
    shortest_contact,
)

#: The lever [m]: length, heights at root and tip, between which it tapers along a parabola, and width.
LENGTH, ROOT, TIP, WIDTH = 0.12, 0.016, 0.006, 0.01
#: One blow: v_I, the length times the jump of the lever's speed [m/s]; the impulse [N s], 30 deg off the lever's axis.
VELOCITY, IMPULSE, ALONG = 1.5, 0.04, math.cos(math.radians(30))
#: What has to be measured or guessed: how long the contact lasts [s], and the radius of the tip [m].
DURATION, TIP_RADIUS = 150e-6, 2e-3
#: A hole across the lever: where [m], and by how much it raises the stress.
HOLE, NOTCH = 0.04, 2.5


@dataclass(frozen=True)
class Blow:
    """What one blow leaves.

    Attributes:
        bending: largest bending stress [Pa], at `place` [m] from the root.
        shear: largest shear stress at the root [Pa], of the force `across` [N] there.
        force: largest of the contact [N].
        axial: mean stress along it at the tip [Pa].
        contact: pressure of the tip on a flat.
        blows: that the hole bears, by Miner's rule.
    """

    bending: float
    place: float
    shear: float
    across: float
    force: float
    axial: float
    contact: LineContact
    blows: float


def height(x: np.ndarray) -> np.ndarray:
    """Of the lever at the distances x from its root [m]."""
    left = 1 - x / LENGTH
    return TIP + (ROOT - TIP) * left * left


def lever() -> SectionBeam:
    """By functions of x."""
    return SectionBeam(
        LENGTH,
        area=lambda x: WIDTH * height(x),
        second_moment=lambda x: WIDTH * height(x) ** 3 / 12,
        outer_fibre=lambda x: height(x) / 2,
        thickness=WIDTH,
    )


def lever_by_table(rows: int = 13) -> TableBeam:
    """The same by rows from root to tip, as a drawing has them, and as a model may declare it."""
    x = np.linspace(0.0, LENGTH, rows)
    h = height(x)
    return TableBeam(tuple(x), tuple(WIDTH * h), tuple(WIDTH * h**3 / 12), tuple(h / 2), thickness=WIDTH)


def blow(beam: SectionBeam | TableBeam, card: MaterialCard) -> Blow:
    """What the blow above leaves in a beam."""
    material, modes = card.material, converged_modes(beam, card.material)
    most = maximum_stress(beam, material, VELOCITY, modes)
    # the fast modes bring the largest shear at once: two periods of the slowest one will do
    times = np.linspace(0.0, 4 * math.pi / modes[0].natural_frequency, 20001)
    force = peak_force(ALONG * IMPULSE, DURATION)
    swings = Ringing(beam, material, [0.0], [VELOCITY], modes).swings(HOLE)
    history = [NOTCH * swing.stress for swing in swings]
    return Blow(
        bending=most.stress,
        place=most.position * beam.length,
        shear=float(np.abs(shear_stress(beam, material, VELOCITY, 0.0, times, modes)).max()),
        across=float(np.abs(shear_force(beam, material, VELOCITY, 0.0, times, modes)).max()),
        force=force,
        axial=float(axial_stress(beam, force, beam.length)[0]),
        contact=hertz_line_contact(force, WIDTH, TIP_RADIUS, material),
        blows=1 / miner_damage(rainflow_cycles(history), card.strength, MeanStress.GOODMAN),
    )


def main() -> None:
    """Print what the blow leaves, of the beam by functions and by its table."""
    card = material_card("42CrMo4")
    print(f"waves run along the lever and back in {1e6 * shortest_contact(lever(), card.material):.1f} us")
    for kind, beam in (("functions", lever()), ("table", lever_by_table())):
        found = blow(beam, card)
        print(f"by {kind}:")
        print(f"  bending {found.bending / 1e6:.1f} MPa at {1e3 * found.place:.1f} mm")
        print(f"  shear {found.shear / 1e6:.1f} MPa at the root, of {found.across:.0f} N")
        print(f"  contact {found.force:.0f} N: along the lever {found.axial / 1e6:.1f} MPa, at its tip", end=" ")
        print(f"{found.contact.pressure / 1e6:.0f} MPa over {2e6 * found.contact.half_width:.0f} um", end=", ")
        print(f"below it shear of {found.contact.shear / 1e6:.0f} MPa at {1e6 * found.contact.shear_depth:.0f} um")
        print(f"  the hole bears {found.blows:.3g} blows")


if __name__ == "__main__":
    main()
