"""Status codes of engine calls; `ADVICE` says what each means and what to do."""

OK = 0
NOT_ASSEMBLED = 1
START_RATES = 2
START_INSIDE = 3
STEP_TOO_SMALL = 4
TOO_MANY_STEPS = 5
NO_CHOICE = 6
CHATTERING = 7
NO_PLACE = 8
JAMMED = 9
ROW_AWAY = 10
OVERLAP = 11
NO_CONTACT_POINT = 12
SINGULAR = 13
BRIDGED = 14
AT_CENTRE = 15
NO_PROGRESS = 16
OUT_OF_REACH = 17
MANY_TOUCH = 18
PENETRATED = 19
PASSED_OVER = 20
FORCE_PASSED_OVER = 21
FEW_POINTS = 22

#: How an event can fail, after which nothing goes on (see `codes.GUARD_FAILED`).
EVENT_FAILURES = (NO_CHOICE, CHATTERING, JAMMED, ROW_AWAY, MANY_TOUCH, PENETRATED, FEW_POINTS)
#: A communication step that ended early; the next one goes on from the time reached.
OUT_OF_STEPS = (TOO_MANY_STEPS, NO_PROGRESS)

ADVICE = {
    NOT_ASSEMBLED: "The joints cannot be closed from the given start positions.",
    START_RATES: "The start rates do not agree with the joints.",
    START_INSIDE: "The mechanism starts with a contact point inside the other body.",
    STEP_TOO_SMALL: "The step size has shrunk to nothing: the motion is no longer smooth or finite. Check that inputs "
    "and parameters are of a sensible size, or give a larger relative_tolerance.",
    TOO_MANY_STEPS: "The communication step needs more internal steps than max_internal_steps: the motion is very fast "
    "for its length. The time reached is good, and the next step goes on from there. Check the size of inputs and "
    "parameters, take shorter communication steps, or give a larger max_internal_steps.",
    NO_PROGRESS: "No progress: a tenth of max_internal_steps has not covered a hundredth of the communication step, "
    "because something is very stiff or very fast. The time reached is good, and the next step goes on from there. "
    "Check the size of inputs and parameters, take shorter communication steps, or give a larger max_internal_steps.",
    NO_CHOICE: "No set of pushing contacts agrees with the motion: all modes of the contacts that touch were tried. "
    "With friction, none has finite forces (Painleve's paradox). Give the mechanism tangential_shock=True, by which an "
    "impact leads on; or less friction, or lengths or start positions that differ a little.",
    MANY_TOUCH: "More contacts touch at once, or stick, than can be resolved. Let fewer of them meet at one instant: "
    "change lengths or start positions a little.",
    FEW_POINTS: "Two outlines touch at more places at once than their OutlineContact has points. Leave its points out, "
    "or give it more.",
    PENETRATED: "Two bodies that may touch have gone into each other: a corner was grazed between two looks, an "
    "outline came in past the open end of another, a pattern went on to a copy whose line the point was behind, or two "
    "that no contact keeps apart carried a third along. Give a smaller relative_tolerance, close the outline, let the "
    "pattern's boundary run through the apex of its lines, or add the contact that is missing.",
    PASSED_OVER: "The integrator of the importing tool has stepped over the event of a contact. Let the tool locate "
    "state events, or give it a smaller tolerance or a smaller largest step.",
    FORCE_PASSED_OVER: "The integrator of the importing tool has stepped over a stretch on which a force acts, or does "
    "not. Let the tool locate state events, or give it a smaller tolerance or a smaller largest step.",
    CHATTERING: "The contacts open and close without end and without progress in time. Give a smaller restitution, or "
    "softer springs and smaller torques.",
    JAMMED: "No finite forces agree with friction from here on (Painleve's paradox; A/G, what a normal force does to "
    "its gap beside what it would without friction, has come to zero). Give less friction, change the line of "
    "action, or give the mechanism tangential_shock=True.",
    ROW_AWAY: "A logical function closes a row where the bodies are not on it. Give the function a limit at which they "
    "are.",
    OVERLAP: "The mechanism starts with two profiles that overlap: they touch at one point and run into each other at "
    "another, because one has a hollow that the other does not fit into.",
    NO_CONTACT_POINT: "The contact point of two profiles is no longer determined: one of them has a hollow there that "
    "the other does not fit into, or a tip. Check the profile's curvature, or give a smaller roller.",
    BRIDGED: "Two profiles that touch at one point have met at a second one: a follower bridges a hollow of its cam. "
    "Give a smaller roller, or a profile without a hollow; a flat face needs a convex one.",
    AT_CENTRE: "A profile reaches its own centre, where its radius is zero or negative. Give a larger mean or base "
    "radius; for a knife edge take a PointFollower.",
    SINGULAR: "A singular configuration lies ahead: the rank of the constraint rows drops there, and the motion may go "
    "on along more than one branch, as where a parallelogram lies flat. Keep the mechanism away from it, or add a part "
    "that leads it through, such as a third crank out of line; or, where it goes on as it came, give the mechanism "
    "through_singularities=True. Where it has that, no smooth branch was found as accurate as asked, an event or rest "
    "is too near to it, or steps are implicit there, which never pass one: the motion is stiff, or integration_method "
    "is 2.",
    OUT_OF_REACH: "The joints cannot be kept from here on: a driver has come to the end of its range, where links lie "
    "in one line, and asks for more. Let its motion turn back before, drive another body, or change lengths.",
    NO_PLACE: "No copy of a pattern was found on which the point can start. Give start positions nearer to the "
    "pattern, or check its pitch and boundary.",
}
