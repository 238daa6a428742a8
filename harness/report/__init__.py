"""Reports: one HTML file each, that needs no network.

Internal: `run_report` and `study_report` serve the commands; the rest are their sections.
"""

__all__: list[str] = []
