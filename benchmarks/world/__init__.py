"""Published problems: a case is one file in `cases`; `python -m benchmarks.world` makes its page in docs/validation."""
