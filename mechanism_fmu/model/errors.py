"""The one error of `mechanism_fmu.model`."""


class MechanismError(ValueError):
    """A mechanism or a parameter that cannot be right.

    The message names the part, the value and the limit, and says what to do; it is meant for the user as it is.
    """
