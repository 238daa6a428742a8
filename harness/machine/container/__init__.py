"""A machine as one FMU: fmpy's container, which knows neither gains nor offsets, and one FMU inside that does.

Internal. `write` puts it together, `description` is its modelDescription.xml.
`gains.c` is that FMU: each of its channels puts out factor * in + offset, at once, without a step.
"""

__all__: list[str] = []
