"""How an engine call ended, as a number; `ADVICE` says what that means and what to do."""

OK = 0
NOT_ASSEMBLED = 1
START_RATES = 2
START_INSIDE = 3
STEP_TOO_SMALL = 4
TOO_MANY_STEPS = 5

ADVICE = {
    NOT_ASSEMBLED: "The joints cannot be closed from the given start positions.",
    START_RATES: "The start rates do not agree with the joints.",
    START_INSIDE: "The mechanism starts with a contact point inside the other body.",
    STEP_TOO_SMALL: "The step size has shrunk to nothing: the motion is no longer smooth or finite. Check that inputs "
    "and parameters are of a sensible size, or give a larger relative_tolerance.",
    TOO_MANY_STEPS: "One communication step needed more internal steps than the limit: the motion is very fast for its "
    "length. Restore a saved state or reset, then check the size of inputs and parameters, or take shorter steps.",
}
