"""Command lines that more than one module's rows are shown by."""

from __future__ import annotations

KED = "mechanism-fmu ked four_bar_path_generator"
STUDY = "mechanism-fmu study ratchet"
RUN = "mechanism-fmu run build/Ratchet.fmu"
