"""Error against time, beside other programs: a case is one file in `cases`; `python -m benchmarks.peers` runs all."""
