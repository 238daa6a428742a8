"""A component in a process of its own: what crashes or hangs there ends the run here, and names do not clash.

Two FMUs of pythonfmu whose scripts have the same name, for instance, cannot be in one process.

- `process`: starts and ends it; `far_side`: what runs there
- `near_side`: the client (proxy), an `interface.Component` for the machine, with as few round trips as can be
- `link` and `protocol`: how requests and replies go; the trouble that a process may make
"""

from .process import (
    TIME_LIMIT as TIME_LIMIT,
    RemoteFmu as RemoteFmu,
    in_own_process as in_own_process,
    remote as remote,
)
