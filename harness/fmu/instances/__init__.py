"""Instances of FMUs by way of fmpy: extracted, instantiated, and always cleaned up.

- `extracted`: the file of an FMU, and its instances (`workspace`: its folder and libraries)
- `common`: what instances have in common (`message_log`: their messages); `fmi2` and `fmi3`: what they have not
- `reals`: variables, bound once
"""
