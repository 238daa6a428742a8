"""The file of a machine: read as a whole, checked against its components, and written.

Internal. `read_file` and `connect_tables` make a `machine_plan`; `notes` says what is no mistake; `write_file` makes a
file of a plan, and one to begin with.
"""

__all__: list[str] = []
