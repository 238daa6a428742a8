"""Options that several commands have; each command says for itself what they are for."""

from __future__ import annotations

from typing import Any

import typer


def settings_option(purpose: str) -> Any:
    """Values for parameters or inputs, once for each."""
    return typer.Option("--set", metavar="NAME=VALUE[UNIT]", help=purpose)


def folder_option(purpose: str = "Folder for the results.", default: str = "the file's name") -> Any:
    """The folder that a command writes into; `default` is what help calls the one that is taken unless given."""
    return typer.Option("-o", "--output", metavar="DIR", help=purpose, show_default=default)


def file_option(metavar: str, default: str, purpose: str = "File to write.") -> Any:
    """The file that a command writes; `default` as of `folder_option`."""
    return typer.Option("-o", "--output", metavar=metavar, help=purpose, show_default=default, dir_okay=False)


def quantity_option(purpose: str) -> Any:
    """A value in any fitting unit; what is taken unless given goes without saying."""
    return typer.Option(metavar="VALUE[UNIT]", help=purpose, show_default=False)
