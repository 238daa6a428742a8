"""Faults of the machine around a command: kills, full disks, deleted caches (docs/how-to/what-can-go-wrong.md).

- `commands`: what is run, what of it is recorded at any moment, and what must come out in the end
- `running`: a command in a process of its own, watched while it runs
- `trials`: one fault after the other
"""
