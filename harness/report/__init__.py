"""Reports: one HTML file each, that needs no network.

Internal: `run_report`, `study_report`, `sweep_report` and `optimum_report` serve the commands; the rest
are their sections.
"""

__all__: list[str] = []
