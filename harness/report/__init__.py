"""Reports: one HTML file each, that needs no network, and figures as files.

Internal: `run_report`, `study_report`, `sweep_report` and `optimum_report` serve the commands. What every report is
made of: a `page.page` of `page.section`s with `page.table`, `page.facts`, `page.checks_list`, `page.versions_section`,
`page.charts`, `parameters.parameters_section` and `animation.animation`. A chart is a `plot.Plot`:
`interactive.interactive` draws it on the page, `static.write_static` into SVG and PNG files.
"""

__all__: list[str] = []
