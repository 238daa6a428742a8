"""One FMU: its description, units and values, and instances of it.

- `description`: the model description, read from modelDescription.xml by `description_file`; `terminals`
- `units` and `values`: as people write them
- `interface`: what a simulation unit is to those around it, so that a test can fake it
- `instances`: by way of fmpy, for both versions of the standard
- `remote`: an instance in a process of its own (`processes`: how those start, end and exchange frames)
"""

from .instances.extracted import Fmu as Fmu, open_fmu as open_fmu
