"""The one error of the package `model`, and where in the user's own code an error arose."""

import traceback
from pathlib import Path


class MechanismError(ValueError):
    """A mechanism or a parameter that cannot be right.

    The message names the part, the value and the limit, and says what to do; it is meant for the user as it is.

    Attributes:
        picture: of two bodies that overlap at the start, an SVG file as text; "" where it is about something else.
    """

    picture = ""


def picture_of(error: BaseException | None) -> str:
    """The picture that an error has, or one that it came from; "" where none has.

    Args:
        error: e.g. one that says in which file the mistake is.
    """
    while error is not None:
        picture: str = getattr(error, "picture", "")
        if picture:
            return picture
        error = error.__cause__
    return ""


def place_of(error: Exception) -> str:
    """Where in the code of a user of this library an error came from: file, line and its text."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if Path(__file__).parent not in Path(frame.filename).parents] or list(frames)
    return f"{own[-1].filename}, line {own[-1].lineno} ({own[-1].line})"
