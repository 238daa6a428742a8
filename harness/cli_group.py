"""Groups of commands whose --help comes at once."""

from __future__ import annotations

from typing import Any

from typer.core import TyperGroup


class Group(TyperGroup):
    """Commands whose --help comes at once.

    When a command is named, the group's own --help was not given; typer imports pydantic (0.2 s) to find that None is
    no Boolean, and does not when it is one.
    """

    def get_help_option(self, ctx: Any) -> Any:
        """The option --help, False unless it is given."""
        option = super().get_help_option(ctx)
        if option is not None:
            option.default = False
        return option
