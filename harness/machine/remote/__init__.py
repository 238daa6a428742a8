"""A component in a process of its own: what crashes or hangs there ends the run here, and names do not clash.

Two FMUs of pythonfmu whose scripts have the same name, for instance, cannot be in one process.

- `process`: starts and ends it
- `component` and `reals`: what a machine has of it (a `machine.component.Component`)
- `round_trips` (`questions`, `link`): how little is sent; the trouble a process may make
- `far_side`: what runs there
"""

from .process import TIME_LIMIT, RemoteFmu, in_own_process, remote

__all__ = ["TIME_LIMIT", "RemoteFmu", "in_own_process", "remote"]
