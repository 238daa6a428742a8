"""`python -m mechanism_fmu` is the command `mechanism-fmu`.

The command's entry point is here, too: the one module of it that has the same name in the tree and in a wheel.
"""

from harness.app.cli import main

if __name__ == "__main__":
    main()
