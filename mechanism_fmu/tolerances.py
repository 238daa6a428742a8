"""The tolerances of events and contacts: applied by the engine, shown to users by `model`.

All are in the scales of the mechanism (`engine.scales`): lengths, their rates, times and forces are multiplied by those
of the mechanism, which are 1 for one of the size of a hand that moves within a second; angles are as they are.

Why each has its value: docs/decisions/005-one-sided-contacts.md, docs/decisions/069-scales.md.
"""

#: A gap less than this touches; one farther below zero at the start is inside.
TOUCHES_WITHIN = 1e-10
#: Start rates agree with the joints within this.
RATES_WITHIN = 1e-9
#: A touching contact whose gap changes more slowly than this is at rest.
RESTS_BELOW = 1e-9
#: A contact that would come apart more slowly than this after an impact stays closed: bouncing ends.
STICK_SPEED = 1e-7
#: What slips more slowly than this, at an event, may stick or slip either way.
SLIPS_ABOVE = 1e-11
#: From so many events on that follow each other without progress in time, what comes apart or slips more slowly than
#: this is at rest: where forces are large, rounding alone gives speeds above those bounds.
PILED = 100
RESTS_WHERE_PILED = 1e-5
SLIPS_WHERE_PILED = 1e-7
#: What sticks goes on to do so while its slip speed is below this: rows may drift so far.
STUCK_BELOW = 1e-9
#: A gap that is zero and does not change may go below zero by this before it counts.
GAP_NOISE = 1e-12
#: How far a boundary, a pitch or a limit is passed before it counts.
MARGIN = 1e-10
#: An open gap that is farther below zero is a penetration, and nothing goes on from there: by how much more a point may
#: have gone behind the line of a copy when its boundary is passed, and the noise by which it may have come deeper; far
#: from the origin and at high speed, more (`contacts.inside`).
DEEPEST = 10.0 * MARGIN + 2.0 * GAP_NOISE
#: How far the end of an element of an outline is passed before a contact goes on to the next one.
PASSES_BY = 1e-11
#: The instant of an event is found when one more Newton step would move it by less than this.
ROOT_TOLERANCE = 1e-13
#: A force that lacks less than these shares still pushes; it opens at twice that (`engine.dynamics.rounding`): of what
#: acts since the last event, which mending of drift disturbs by so much, and of the largest force along any row, by the
#: masses.
PUSHES_WITHIN = 1e-11
PUSHES_SHARE = 1e-11
#: An acceleration may miss this share of what acts: rows that depend on each other contradict each other by 1e-11 m.
ACCELERATIONS_WITHIN = 1e-9
#: Behind an impact, a rate may miss this share of the rates in its row: 10,000 times the rounding of one of them.
SPEEDS_SHARE = 2e-12
#: A row that a logical function closes may be off by this: mending would otherwise be a jump.
CLOSES_WITHIN = 1e-6
#: Position rows are closed when none is off by more than this; in kinematic analysis, of the size of the mechanism.
CLOSED_WITHIN = 1e-12
