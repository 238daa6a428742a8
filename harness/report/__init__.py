"""Reports: one HTML file each, that needs no network, and figures as files.

Internal: `run_report`, `sweep_report`, `optimum_report` and `machine_report` serve the commands. What every report is
made of: a `page.page` of `page.section`s with `page.table`, `page.facts`, `page.checks_list`, `page.versions_section`,
`page.charts`, `parameters.parameters_section` and `animation.animation`. A chart is a `plot.Plot`:
`plot.interactive` makes data of it that `curves.js` draws on the page, `static.write_static` draws it into SVG and PNG
files. `packed` compresses the data of charts, `packed.js` opens them; `style` has colours, for light and dark.
"""

__all__: list[str] = []
