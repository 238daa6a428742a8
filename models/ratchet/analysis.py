"""What can be analysed of the ratchet: the stress in its teeth, and how far crank and pawl give way."""

from __future__ import annotations

from mechanism_fmu.model import Arm, ImpactStress, SawtoothWheel, SeriesCompliance, Strut, WedgeTooth

ANALYSIS = (
    ImpactStress(
        "face",
        WedgeTooth("tooth_length", "tooth_apex_angle"),
        "tooth",
        "teeth",
        slenderness="tooth_slenderness",
        strokes="clicks",
    ),
    SeriesCompliance(
        "face",
        Arm("crank", "crank_length", "crank_width", "crank_depth", "crank_stiffness", angle="crank_angle"),
        Strut(
            *("pawl", "pawl_length", "pawl_width", "pawl_depth", "pawl_stiffness"),
            angle="pawl_angle",
            deflection="pawl_tip_deflection",
            stress="pawl_bending_stress",
        ),
        SawtoothWheel(
            "wheel",
            "tooth",
            radius="wheel_inner_radius",
            pitch="tooth_pitch",
            slope_angle="tooth_slope_angle",
            apex_angle="tooth_apex_angle",
            angle="wheel_angle",
            index="tooth_index",
            struck="tooth",
            slope_force="slope_force",
            face_force="contact_force",
        ),
        restitution="restitution",
        source="models/ratchet/README.md",
    ),
)
