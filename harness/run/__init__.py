"""One run of one FMU: time, inputs, what is recorded, verdicts, and the files of it all.

- `master`: moves time in whole nanoseconds, observers look on and record; `inputs`: signals that drive the FMU
- `drawing`: how its mechanism is drawn; `logic`: its modes, transitions and events
- `experiment`: puts all that together; `checks`: verdicts; `results`: files
- `validate`: whether an FMU keeps what it promises
"""

__all__ = ["experiment", "master", "results"]
