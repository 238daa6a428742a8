"""A model in one HTML file: the engine runs in the page, as WebAssembly.

`shown` is for notebooks; the rest is internal: `page_file.page` serves the command `mechanism-fmu page`. The scripts,
one job a file, are those beside it and the player of the reports; `page_data.page_data` says what they get, and
`payload.payload` is what any file holds in which a model runs.
"""

__all__ = ["shown"]
