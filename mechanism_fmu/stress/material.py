"""Materials of a beam, and material cards: steels with their strength, and where each number is printed."""

from __future__ import annotations

from dataclasses import dataclass

from .beam import require_within
from .fatigue import Strength

# Materials of a beam.


@dataclass(frozen=True)
class Material:
    """A linear elastic material with modal damping.

    Attributes:
        youngs_modulus: E [Pa], 1 to 1e15.
        density: rho [kg/m3], 1e-3 to 1e6.
        damping_ratio: zeta [-] of every mode, 0 (undamped) to 0.99 (the response must oscillate).

    Raises:
        ValueError: when a value is outside its limits or not a number.
    """

    youngs_modulus: float
    density: float
    damping_ratio: float

    def __post_init__(self) -> None:
        """Refuse a value outside its limits."""
        require_within("Young's modulus", self.youngs_modulus, 1.0, 1e15, "Pa", "steel has 2.06e11")
        require_within("density", self.density, 1e-3, 1e6, "kg/m3", "steel has 7850")
        require_within("damping ratio", self.damping_ratio, 0.0, 0.99, "", "the mode must oscillate; steel has 0.03")


#: Steel; the damping ratio is the paper's (Pennestrì, Valentini, Vita, section 5), E and rho are handbook values.
STEEL = Material(youngs_modulus=2.06e11, density=7850.0, damping_ratio=0.03)


# Material cards: steels with their strength, and where each number is printed.
#
# Every card gives minimum values of a standard or mean values of tests, of smooth specimens at room temperature.
# Notches, surface, size, the tooth's own heat treatment and scatter are not in them: docs/explanation/stress.md.

_PAPER_DAMPING = "zeta: 0.03 for steel, Pennestrì, Valentini, Vita, section 5"
_HANDBOOK = "E, rho: usual handbook values of steel, not of this one in particular"
_EUROCODE = "E: EN 1993-1-1, 3.2.6; rho: EN 1993-1-2, 3.2.2"
_UNIFORM_MATERIAL_LAW = (
    "sigma_f', b: no test data of this steel; estimated from the least R_m by the uniform material law for unalloyed "
    "and low-alloy steels, sigma_f' = 1.5 R_m, b = -0.087: A. Bäumel, T. Seeger, Materials Data for Cyclic Loading, "
    "Supplement 1, Elsevier 1990"
)
_DOWLING = (
    "R_e, R_m, sigma_f', b: axial tests of unnotched specimens at zero mean stress, N. E. Dowling, Mechanical Behavior "
    "of Materials, 4th ed., Table 9.1"
)
_EUROCODE_STEEL = Material(youngs_modulus=2.1e11, density=7850.0, damping_ratio=STEEL.damping_ratio)


@dataclass(frozen=True)
class MaterialCard:
    """A material by name, with what it bears and where that is from.

    Attributes:
        name: of the card, as `--material` takes it.
        text: what it is.
        material: elasticity, density and damping.
        strength: static and fatigue.
        sources: of every number.
    """

    name: str
    text: str
    material: Material
    strength: Strength
    sources: tuple[str, ...]


def _estimated(least_yield: float, least_tensile: float) -> Strength:
    """Strength from R_e and R_m [Pa], fatigue by the uniform material law."""
    return Strength(least_yield, least_tensile, 1.5 * least_tensile, -0.087)


def _structural(name: str, text: str, strength: Strength, standard: str) -> MaterialCard:
    """A structural or heat-treatable steel by a standard, which says the least R_e and R_m."""
    sources = (_EUROCODE, _PAPER_DAMPING, f"R_e, R_m: least of {standard}", _UNIFORM_MATERIAL_LAW)
    return MaterialCard(name, text, _EUROCODE_STEEL, strength, sources)


def _tested(name: str, text: str, strength: Strength) -> MaterialCard:
    """A steel with measured fatigue."""
    return MaterialCard(name, text, STEEL, strength, (_HANDBOOK, _PAPER_DAMPING, _DOWLING))


_CARDS = (
    MaterialCard(
        "steel",
        "Generic structural steel: the paper's, with the strength of the weakest common structural steel",
        STEEL,
        _estimated(235e6, 360e6),
        (_HANDBOOK, _PAPER_DAMPING, "R_e, R_m: least of S235, EN 10025-2, up to 16 mm thick", _UNIFORM_MATERIAL_LAW),
    ),
    _structural("S355", "Structural steel S355J2", _estimated(355e6, 470e6), "EN 10025-2, up to 16 mm thick"),
    _structural(
        "C45E",
        "Heat-treatable steel C45E, quenched and tempered",
        _estimated(430e6, 650e6),
        "EN 10083-2, 16 to 40 mm diameter",
    ),
    _structural(
        "42CrMo4",
        "Heat-treatable steel 42CrMo4, quenched and tempered",
        _estimated(750e6, 1000e6),
        "EN 10083-3, 16 to 40 mm diameter",
    ),
    _tested("SAE1015", "Carbon steel SAE 1015, normalised", Strength(228e6, 415e6, 1020e6, -0.138)),
    _tested(
        "SAE4142",
        "Alloy steel SAE 4142, quenched and tempered to 450 HB",
        Strength(1584e6, 1757e6, 1937e6, -0.0762),
    ),
    _tested("AISI4340", "Alloy steel AISI 4340, aircraft quality", Strength(1103e6, 1172e6, 1758e6, -0.0977)),
)

#: All cards by name.
CARDS = {card.name: card for card in _CARDS}

#: The card for those who name none.
STEEL_CARD = CARDS["steel"]


def material_card(name: str) -> MaterialCard:
    """The card with this name; capitals do not matter.

    Args:
        name: of the card, one of `CARDS`.

    Raises:
        ValueError: there is none; with all names.

    Source: that of each number is in the card's `sources`.
    """
    for card in CARDS.values():
        if card.name.lower() == name.lower():
            return card
    raise ValueError(f"there is no material '{name}'; there are {', '.join(CARDS)}.")
