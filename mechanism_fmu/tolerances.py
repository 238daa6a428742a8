"""The fixed tolerances of events and contacts, in SI units: applied by the engine, shown to users by `model`.

Why each has its value: docs/decisions/005-one-sided-contacts.md.
"""

#: A gap less than this touches; one farther below zero at the start is inside [m, rad].
TOUCHES_WITHIN = 1e-9
#: Start rates agree with the joints within this [m/s, rad/s].
RATES_WITHIN = 1e-9
#: A touching contact whose gap changes more slowly than this is at rest [m/s, rad/s].
RESTS_BELOW = 1e-9
#: A contact that would come apart more slowly than this after an impact stays closed [m/s, rad/s]: bouncing ends.
STICK_SPEED = 1e-6
#: What slips more slowly than this, at an event, may stick or slip either way [m/s, rad/s].
SLIPS_ABOVE = 1e-11
#: From so many events on that follow each other without progress in time, what comes apart or slips more slowly than
#: this is at rest [m/s, rad/s]: where forces are large, rounding alone gives speeds above those bounds.
PILED = 100
RESTS_WHERE_PILED = 1e-4
SLIPS_WHERE_PILED = 1e-7
#: What sticks goes on to do so while its slip speed is below this [m/s, rad/s]: rows may drift so far.
STUCK_BELOW = 1e-9
#: A gap that is zero and does not change may go below zero by this before it counts [m, rad].
GAP_NOISE = 1e-12
#: An open gap that is farther below zero is a penetration, and nothing goes on from there [m, rad]: what touches, and
#: the noise by which it may have come deeper; far from the origin and at high speed, more (`contacts.inside`).
DEEPEST = TOUCHES_WITHIN + 2.0 * GAP_NOISE
#: How far a boundary, a pitch or a limit is passed before it counts [m, rad].
MARGIN = 1e-10
#: The instant of an event is found when one more Newton step would move it by less than this [s].
ROOT_TOLERANCE = 1e-13
#: A force that lacks less than this [N, N m], or this share of the largest one, still pushes; it opens at twice that.
PUSHES_WITHIN = 1e-9
PUSHES_SHARE = 1e-11
#: A row that a logical function closes may be off by this [m, rad]: mending would otherwise be a jump.
CLOSES_WITHIN = 1e-6
#: Position rows are closed when none is off by more than this [m, rad, m^2].
CLOSED_WITHIN = 1e-12
