"""Work against precision beside other programs: a case is one file in `cases`; `python -m benchmarks.peers` runs them."""
