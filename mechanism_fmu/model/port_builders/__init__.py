"""Builders of the ports that many mechanisms have: one name, one unit, one set of limits and one meaning everywhere.

A builder returns a plain `Input`, `Output` or `Parameter`, or several in a tuple, to be unpacked with a star; what is
not here is written as such. Names end in `_input`, `_output` or `_parameter`, with an s where several are returned.
Builders that are given a part ("crank") form the names of its ports from it ("crank_angle"). All are imported from
`mechanism_fmu.model`, like the parts.
"""
