"""What the commands `machine ...` do.

Internal. `prepare` makes a machine of its file, `parts` instances of its components; `performed` is a run, `run` what
is said of it, `files` what is written; `check` and `exchange` are the other commands.
"""

__all__: list[str] = []
