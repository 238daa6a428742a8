"""A live matrix: the FMUs of this project in tools that are not of this project.

    python -m tests.importers

runs every tool that is installed on every form of FMU and writes the table into docs/how-to/plug-it-into-your-tool.md.
As tests, the same runs are in `test_matrix.py`. A tool is one file here: what to install, which forms it takes, how it
is run.
"""
