"""Machines as SSP 1.0 (System Structure and Parameterization): .ssp files for other tools, and from them.

Internal. `export` writes; `structure` reads what a file says, `importing` makes a machine's file of it. `own` has
what SSP has no words for and this project writes into annotations, `xml` the namespaces.
"""

__all__: list[str] = []
