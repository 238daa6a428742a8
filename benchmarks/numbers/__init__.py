"""The numbers of this project in one table, docs/project/numbers.md, and their history in one file beside it."""
