"""Groups of commands whose --help comes at once, and which end in order when the system asks them to."""

from __future__ import annotations

from typing import Any

from typer.core import TyperGroup

from .exhausted import exhaustion_told
from .termination import terminable


class Group(TyperGroup):
    """Commands whose --help comes at once.

    When a command is named, the group's own --help was not given; typer imports pydantic (0.2 s) to find that None is
    no Boolean, and does not when it is one.
    """

    def main(self, *arguments: Any, **options: Any) -> Any:
        """Run the command; SIGTERM ends it as Ctrl-C does, and what is full is told in a line."""
        with terminable(), exhaustion_told():
            return super().main(*arguments, **options)

    def get_help_option(self, ctx: Any) -> Any:
        """The option --help, False unless it is given."""
        option = super().get_help_option(ctx)
        if option is not None:
            option.default = False
        return option
