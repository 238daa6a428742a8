"""How a mechanism moves: a generic, table-driven engine in the part of Python that compiles without Python objects.

Entry points, each taking an instance's block: `assembly.begin`, `stepper.advance`,
`outputs.read_outputs`.
"""
