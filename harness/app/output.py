"""Output of a command as its caller wants it: for people, nothing but errors (--quiet), or as JSON (--json)."""

from __future__ import annotations

import contextlib
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

#: Options of all commands, which may stand anywhere before "--".
QUIET, JSON = "--quiet", "--json"

#: What has been said so far, as data; None where nobody asks for it.
_data: dict[str, Any] | None = None


def in_front(arguments: Sequence[str]) -> list[str]:
    """Arguments with the options of all commands before the command: `run FMU --json` becomes `--json run FMU`."""
    end = arguments.index("--") if "--" in arguments else len(arguments)
    common = [word for word in arguments[:end] if word in (QUIET, JSON)]
    return [*common, *(word for word in arguments[:end] if word not in (QUIET, JSON)), *arguments[end:]]


@contextlib.contextmanager
def as_wanted(arguments: Sequence[str]) -> Iterator[None]:
    """Run a command with these arguments: nothing on stdout with --quiet, one JSON object there with --json.

    Warnings and errors are on stderr as ever. The object has the `exit_code`, what the command gives as its result,
    and lists of what it shows: `checks`, `tables`, `files`, `notes`, `warnings`, `errors`; `printed` holds lines of
    commands that show nothing of these.
    """
    global _data
    before = in_front(arguments)
    wants = {word for word in before[:2] if word in (QUIET, JSON)}
    if not wants or "--help" in arguments:
        yield
        return
    _data = {} if JSON in wants else None
    printed, code = io.StringIO(), 0
    try:
        with contextlib.redirect_stdout(printed):
            yield
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
        raise
    except BaseException:
        code = 1
        raise
    finally:
        found, _data = _data, None
        if found is not None:
            lines = {} if found else {"printed": printed.getvalue().splitlines()}
            with contextlib.suppress(BrokenPipeError):
                print(json.dumps({"exit_code": code, **found, **lines}, indent=2, ensure_ascii=False, default=str))


def give(result: Mapping[str, Any]) -> None:
    """Have the result of a command in the JSON object, if one is wanted."""
    if _data is not None:
        _data.update(result)


def note(kind: str, entry: Any) -> None:
    """Add something that is shown to the list `kind` of the JSON object, if one is wanted."""
    if _data is not None:
        _data.setdefault(kind, []).append(entry)
