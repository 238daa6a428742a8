"""What the commands `sweep` and `optimise` do.

Internal. `sweep` and `optimise` are one each; `shared` is what both need: the FMU, who runs the designs, the bar.
"""

__all__: list[str] = []
