"""The paper's teeth by finite elements: harness/plane_teeth.csv, made by `python -m benchmarks.plane_teeth`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pandas as pd

FILE = Path(__file__).with_name("plane_teeth.csv")

#: x / l where the stresses are compared: the paper's place of the maximum.
PLACE = 0.4


@dataclass(frozen=True)
class PlaneTooth:
    """A tooth as a plate (plane stress, Poisson's ratio 0.3) beside the paper's beam; all ratios [-].

    `wedge` is the paper's right-angled triangle as a plate, `tooth` the triangle of root, apex and next root.

    Attributes:
        tooth_count: nt.
        slope_angle_deg: beta_0 [deg].
        slenderness: l over the height of the wedge's root, 1 / tan(alpha).
        beam_to_wedge_frequency, beam_to_tooth_frequency: eq (15) over the plate's first frequency.
        static_wedge_face, static_wedge_slope, static_tooth_face, static_tooth_slope: stress along the flank at
            x / l = 0.4, plate over beam, under the inertia of an angular acceleration about the root.
        impact_wedge_face, impact_wedge_slope, impact_tooth_face, impact_tooth_slope: the same of the first mode alone,
            for one velocity v_I.
    """

    tooth_count: int
    slope_angle_deg: int
    slenderness: float
    beam_to_wedge_frequency: float
    beam_to_tooth_frequency: float
    static_wedge_face: float
    static_wedge_slope: float
    static_tooth_face: float
    static_tooth_slope: float
    impact_wedge_face: float
    impact_wedge_slope: float
    impact_tooth_face: float
    impact_tooth_slope: float

    @property
    def left_out(self) -> float:
        """How much lower the first frequency of the whole tooth lies than that of the wedge [-]."""
        return 1.0 - self.beam_to_wedge_frequency / self.beam_to_tooth_frequency

    @property
    def static_wedge(self) -> float:
        """The larger one of both flanks."""
        return max(self.static_wedge_face, self.static_wedge_slope)

    @property
    def static_tooth(self) -> float:
        """The larger one of both flanks."""
        return max(self.static_tooth_face, self.static_tooth_slope)

    @property
    def impact_wedge(self) -> float:
        """The larger one of both flanks."""
        return max(self.impact_wedge_face, self.impact_wedge_slope)

    @property
    def impact_tooth(self) -> float:
        """The larger one of both flanks."""
        return max(self.impact_tooth_face, self.impact_tooth_slope)


def plane_teeth() -> tuple[PlaneTooth, ...]:
    """The teeth of the paper's 20 wheels."""
    rows = pd.read_csv(FILE, comment="#").to_dict("records")
    return tuple(PlaneTooth(**{str(name): value for name, value in row.items()}) for row in rows)
