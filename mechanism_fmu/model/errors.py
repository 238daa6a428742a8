"""The one error of the model room."""


class MechanismError(ValueError):
    """A mechanism or a parameter that cannot be right.

    The message names the part, the value and the limit, and says what to do; it is meant for the user as it is.
    """
