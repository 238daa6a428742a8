"""All tools by their keys.

As a program, it runs one of them: `python -m tests.importers.tools KEY VALUES.json < ASKED.json`.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from tests.importers import in_c, in_container, in_ecos, in_fmi_library, in_fmpy, in_fmusim, in_libcosim
from tests.importers.asked import Asked

TOOLS = {
    "fmpy": in_fmpy.TOOL,
    "libcosim": in_libcosim.TOOL,
    "ecos": in_ecos.TOOL,
    "container": in_container.TOOL,
    "fmi_library": in_fmi_library.TOOL,
    "fmusim": in_fmusim.TOOL,
    "c": in_c.TOOL,
}


def main() -> None:
    key, out = sys.argv[1:]
    values = TOOLS[key].run(Asked.from_json(sys.stdin.read()))
    Path(out).write_text(json.dumps(values), encoding="utf-8")


if __name__ == "__main__":
    main()
