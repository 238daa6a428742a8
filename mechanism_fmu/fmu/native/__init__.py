"""The native flavour: the engine compiled ahead of time, and an FMI surface in C around it.

For users: `package.build_native_fmu`. The rest makes its pieces: a model's data and formulas as C (`model_data`,
`formulas`), the engine's objects (`objects`, `emit`), the description of FMI 3.0, and the linking for each platform.
"""

__all__ = ["package"]
