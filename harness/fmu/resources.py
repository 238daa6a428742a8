"""JSON files among the resources of an FMU, which its author may have left out or spoiled."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

#: The format of all of them that is understood.
_FORMAT = 1


class FlawError(ValueError):
    """What is wrong with a file, for the user."""


def parsed(text: str, key: str) -> dict[str, Any]:
    """What a file says.

    Args:
        text: of the file.
        key: whose value is a list.

    Raises:
        FlawError: it is no JSON, has no such list, or is of another format.
    """
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FlawError(f"it is no JSON ({error})") from error
    if not isinstance(data, dict) or not isinstance(data.get(key), list):
        raise FlawError(f"it holds no list of {key}")
    if data.get("format") != _FORMAT:
        raise FlawError(f"its format is {data.get('format')!r:.60}, and this harness knows format {_FORMAT}")
    return data


def resource(folder: Path, name: str, key: str) -> dict[str, Any] | None:
    """What the file resources/`name` of the FMU extracted to `folder` says, as of `parsed`; None when there is none.

    Raises:
        FlawError: as of `parsed`, or it cannot be read.
    """
    try:
        return parsed((folder / "resources" / name).read_text(encoding="utf-8"), key)
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise FlawError(f"it cannot be read ({error})") from error
