"""The file of a machine: read as a whole, checked against its components, and written.

Internal. `components`, then `read` (all of it: `connections`, `running`) make a `plan`; `notes` says what is no
mistake, `write` makes a file of a plan, `new` one to begin with; `changes` are those of a command.
"""

__all__: list[str] = []
