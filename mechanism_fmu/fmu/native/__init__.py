"""The native flavour: the engine compiled ahead of time, and an FMI surface in C around it.

For users: `package.build_native_fmu`, and `web.web_model` for pages. The rest makes their pieces: a model's data and
formulas (`model_data`, `formulas`) as C (`model_source`) or as bytes (`model_image`), the engine's objects (`objects`,
`emit`), the description of FMI 3.0, and the linking for each platform.
"""

__all__ = ["package"]
