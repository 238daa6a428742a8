"""Integer codes shared by the tables (written by `model`) and the engine (which reads them).

Plain integers, because compiled code freezes module-level integers as constants.
"""

#: No contact, pattern or logical function.
NONE = -1

# contact_kind
POINT_LINE = 0
ANGLE_STOP = 1
ANGLE_LOCK = 2
CAM_FOLLOWER = 3
CAM_FLAT_FOLLOWER = 4
POINT_FOLLOWER = 5
OUTLINE = 6  # a place where two outlines touch

# feature_kind: what an outline consists of; its vertices and elements follow each other
VERTEX = 0
SEGMENT = 1
ARC = 2

# feature_data columns
FEATURE_X = 0  # a vertex, the start of a segment, the centre of an arc [m]
FEATURE_Y = 1
FEATURE_DX = 2  # of travel on arriving at a vertex, and along a segment; from the centre to the middle of an arc
FEATURE_DY = 3
FEATURE_LEAVES_X = 4  # of travel on leaving a vertex; zeros at a free end, as where there is no arriving
FEATURE_LEAVES_Y = 5
FEATURE_LENGTH = 4  # of a segment [m]
FEATURE_RADIUS = 4  # of an arc [m], negative where it is hollow
FEATURE_HALF = 5  # half the sweep of an arc [rad]
FEATURE_TURN = 6  # the sine by which the way turns at a vertex, to the left; `FREE_END` at the end of a chain
FEATURE_COLUMNS = 7
FREE_END = 2

# outline_data columns
OUTLINE_X = 0  # the centre of a circle around it [m]
OUTLINE_Y = 1
OUTLINE_RADIUS = 2
OUTLINE_PITCH = 3  # from one copy to the next [rad]; 0 where copies stand in a row
OUTLINE_DX = 4  # or [m]
OUTLINE_DY = 5
OUTLINE_COLUMNS = 6

# contact_data columns: of POINT_LINE the point and (as contact_line) the line; of profiles see their specs; of
# ANGLE_STOP and ANGLE_LOCK:
STOP_ANGLE = 0
STOP_PITCH = 1

# contact_value columns
RESTITUTION = 0
FRICTION = 1
GUIDED = 2
ENABLED = 3
STARTS_CLOSED = 4
FRICTION_STATIC = 5  # while it sticks
CONTACT_VALUES = 6

# contact_hollow (state): whether a profile of the pair has a hollow, and whether the other one may bridge it
CONVEX = 0
HOLLOW = 1
BRIDGES = 2

# contact_mode (state)
OPEN = 0
CLOSED = 1

# contact_touching (state): 0, 1, or this: rows that contradict each other by rounding have left an open one inside
LEFT_INSIDE = 2

# rub_slip (state): how a contact or joint with friction moves along; 0 where it does not touch
APART = 0
FORWARDS = 1
BACKWARDS = -1
STICKS = 2

# rub_free: whether it may stick or slip either way at an instant; what has let go does not stick again at that instant
BOUND = 0
FREE = 1
LET_GO = 2

# function_kind: what a logical function looks at
ALONG = 0
ANGLE = 1

# threshold_kind: what comes to zero where a force begins, ends, or goes over to another formula
THRESHOLD_SIDE = 0  # the stretch of a one-sided spring
THRESHOLD_PULL = 1  # the force of the same one, which never holds back
THRESHOLD_CONDITION = 2  # the condition of an operation of a law
THRESHOLD_PIECE = 3  # the way to the next piece of a curve

# threshold_side (state): the sign of it in the present step; 0 where each evaluation decides for itself
BELOW = -1
UNDECIDED = 0
ABOVE = 1
CROSSES = 2  # times the sign: until the end of the step, where it comes to zero

# term_data columns: a term of a curve is a polynomial and one harmonic
POLYNOMIAL = 0
AMPLITUDE = 6
FREQUENCY = 7
PHASE = 8
TERM_COLUMNS = 9

# member_data columns: how far a member gives way, and from section forces to stress
MEMBER_STRETCH = 0  # l / EA [m/N]
MEMBER_BENDING = 1  # l / EI [1/(N m)]
MEMBER_AREA = 2
MEMBER_MODULUS = 3  # section modulus 2 I / h [m3]
MEMBER_COLUMNS = 4

# lump_data columns
LUMP_MASS = 0
LUMP_INERTIA = 1
LUMP_SHARE = 2  # of the mass of its body's lumps
LUMP_COLUMNS = 3

# beam_data columns: a member whose start is a hinge and whose end is free, or pushed
BEAM_ALONG_X = 0  # unit vector from hinge to tip, in the frame of the body
BEAM_ALONG_Y = 1
BEAM_SPAN = 2  # [m]
BEAM_CENTRE = 3  # distance of the body's centre of mass from the hinge [m]
BEAM_STIFFNESS = 4  # EI [N m2]
BEAM_MODULUS = 5  # section modulus 2 I / h [m3]
BEAM_SIDE = 6  # of the hinge: 1 where the body is its body i, else -1
BEAM_COLUMNS = 7

# oscillation_swing columns (state): what is known of an oscillation
SWING_SEEN = 0  # up to this time [s]
SWING_SIDE = 1  # 1 where the angle is above its middle, else -1
SWING_SENSE = 2  # 1 where the angle grows, else -1
SWING_REACH = 3  # how far from the middle it has turned since the last passage [rad]
SWING_ABOVE = 4  # that of the last half swing above the middle, and below it; 0: there was none
SWING_BELOW = 5
SWING_PASSAGES = 6  # of the middle, upwards
SWING_TIME = 7  # of the last of them [s]
SWING_WORK = 8  # done on the mechanism until then [J]
SWING_PERIOD = 9  # the last one [s]; 0: there was none
SWING_POWER = 10  # mean of it [W]
SWING_COLUMNS = 11

# settings columns
RELATIVE_TOLERANCE = 0
BAUMGARTE_ALPHA = 1
BAUMGARTE_BETA = 2
MOST_STEPS = 3  # internal ones of one communication step
METHOD = 4  # of integration: AUTOMATIC ...
IMPACT_LAW = 5
ENERGY_GUARD = 6  # 1: an impact that would add energy is repeated by Poisson's law
TANGENTIAL_SHOCK = 7  # 1: where no finite forces agree with friction, an impact without approach
THROUGH_SINGULARITIES = 8  # 1: singular configurations are passed along the smooth branch
SETTINGS = 9

# method of integration
AUTOMATIC = 0  # explicit, and implicit where the motion is stiff
EXPLICIT = 1
IMPLICIT_METHOD = 2

# impact_law
NEWTON = 0
POISSON = 1
STRONGE = 2

# output_kind: what an output reads; output_index says of which, output_slot of which buffered impact
CONSTANT = 0
UNKNOWN = 1  # index: among the engine's unknowns, positions, rates, work done ...
COUNTER = 2
CONTACT_FORCE = 3
CONTACT_GAP = 4
KINETIC_ENERGY = 5
SPRING_ENERGY = 6
ENERGY_LOST = 8
IMPACT_FLAG = 12
LAST_IMPACT = 13
BUFFERED_IMPACT = 14
CONTACT_CLOSED = 15
PATTERN_INDEX = 16
STOP_CLICKS = 17
STOP_REFERENCE = 18
FORCE_READING = 19  # slot: which of those of its kind
BUFFERED_EVENT = 22
JOINT_FORCE = 23
NODE_PLACE = 28  # of the rigid motion; index 2 * node + axis
NODE_BENT = 29  # with the deflection
NODE_DEFLECTION = 30  # index 3 * node + (x, y, rotation)
NODE_DEVIATION = 31
MEMBER_FORCE = 32  # index 3 * member + (along it, moments on its start and end); times the output's value
MEMBER_STRESS = 33
BEAM_DEFLECTION = 34
BEAM_STRESS = 35
SLIP_SPEED = 36  # index: of friction, contacts, joints, and elements
FRICTION_FORCE = 37
STICKS_NOW = 38
GAP_ACCELERATION = 39  # of a contact
SLIP_ACCELERATION = 40
ECCENTRICITY = 41  # of a joint with play: distance from the middle [m], times the output's value
CONTACT_ANGLE = 42
SLIDING_WORK = 43  # times the output's value

# columns of an impact record; behind them: impulse of every contact, then all rates before the instant, then after it
RECORD_TIME = 0
RECORD_CONTACT = 1
RECORD_TOOTH = 2
RECORD_CLOSING_SPEED = 3
RECORD_IMPULSE = 4
RECORD_VELOCITY = 5  # l times the jump of the toothed body's rate
RECORD_INSTANT = 6  # counts instants with impacts from 1: all records of one share jump, rates and energy
RECORD_ENERGY = 7  # lost at this instant
RECORD_CONTACT_IMPULSES = 8

#: So many impacts of one communication step are kept, the last ones, where outputs do not ask for more.
IMPACT_BUFFER_LENGTH = 8
#: No more impacts or events of a communication step can be kept.
MOST_KEPT = 1000

# guards: what an event is about
GUARD_NONE = -1
GUARD_GAP = 0  # an open contact's gap reaches 0
GUARD_PUSH = 1  # a closed contact's force reaches 0
GUARD_NEXT = 2  # a point leaves its copy of a pattern for the next one
GUARD_PREVIOUS = 3  # ... or for the previous one
GUARD_CLICK = 4  # a stop with memory has been passed by one pitch
GUARD_FUNCTION = 5  # a logical function changes
GUARD_INPUT = 6  # an input has changed
GUARD_BEGIN = 7  # the motion begins
GUARD_FAILED = 8  # an event could not be resolved: nothing goes on from there (the status stands as subject)
GUARD_STICK = 9  # the slip speed of a contact or joint with friction reaches 0
GUARD_SLIP = 10  # the friction of one that sticks reaches its bound
GUARD_SHOCK = 11  # no finite forces agree with friction: an impact without approach
GUARD_SEVERAL = 12  # forces of several modes agree with the motion, one of which is taken (Painlevé)
GUARD_UNDETERMINED = 13  # friction depends on forces that the rows share out at will
GUARD_HANDOVER = 14  # where two outlines touch, one of them goes over to its next feature

# stop rules: where `stepper.go_on` stops; those but the first may be added
STOP_AT_TARGET = 0
STOP_AT_IMPACT = 1  # ... or right after an event with an impact
STOP_AT_STEP = 2  # ... or at the end of each of the engine's own steps
STOP_AT_EVENT = 8  # ... or right after any event
STOP_BEFORE_EVENT = 4  # ... or at an event that has not happened yet: outputs are left limits

# what `exchange` does for an importer with its own integrator (Model Exchange)
EXCHANGE_RATES = 0  # the derivative of y_end
EXCHANGE_INDICATORS = 1
EXCHANGE_EVENTS = 2  # all that is due happens
EXCHANGE_MORE_EVENTS = 3  # ... once more in the same event mode, in which records are not emptied
EXCHANGE_COMPLETED = 4  # the importer has accepted a step

# columns of an event record
EVENT_TIME = 0
EVENT_GUARD = 1
EVENT_SUBJECT = 2  # number of the contact, pattern or logical function; of friction, contacts, joints, and elements
EVENT_IMPULSE = 3  # total normal impulse over all contacts [N s]
EVENT_OLD_MODE = 4  # sum of 2^c over closed contacts c, of the first `MODE_BITS`
EVENT_NEW_MODE = 5
EVENT_COLUMNS = 6  # and for each `MODE_BITS` more contacts two columns more, of their old and of their new mode
#: So many contacts have their modes in one number, which is exact.
MODE_BITS = 50

#: So many events of one communication step are kept, the last ones, where outputs do not ask for more.
EVENT_BUFFER_LENGTH = 16

# columns of the state's clock [s]
TIME = 0  # up to which the outside has come
STEP_START = 1  # the engine's own step, which may reach beyond TIME
STEP_END = 2
STEP_SIZE = 3
NEXT_STEP = 4
LAST_EVENT = 5  # when the run of events began that PILE counts
RAMP_START = 6  # when the slopes of inputs began to act
RAMP_END = 7  # up to where they are known: no step goes beyond
STEP_BEGUN = 8  # where the communication step began
PASSED_AT = 9  # of the last singular configuration that was passed; before the first one, where the motion began
COMPLETED = 10  # the last step of an importer that integrates itself
CLOCK_LENGTH = 11

# columns of the state's counters
COUNT_IMPACTS = 0
COUNT_IN_STEP = 1
COUNT_LOST = 2
COUNT_STEPS = 3  # accepted steps since the start
PENDING_GUARD = 4  # guard of the event that waits at STEP_END, or GUARD_NONE
PENDING_SUBJECT = 5  # its contact, pattern or logical function
COUNT_PULLS = 6  # guided contacts that have pulled, as far as the engine has computed
COUNT_EVENTS = 7
EVENTS_IN_STEP = 8
PILE = 9  # events that followed each other without progress
RAMPING = 10  # 1 while an input has a slope
RANK = 11  # of the active rows since the last event
FALLING = 12  # 1 when `course.independence_end` was falling at STEP_END
COUNT_INSTANTS = 13  # with impacts, since the start
STEPS_IN_STEP = 14  # internal steps of the communication step
COUNT_REJECTED = 15  # steps since the start whose error was too large
COUNT_TRIES = 16  # steps since the start that were tried: accepted, rejected, or to find an event
COUNT_BY_POISSON = 17  # rounds of impacts for which another law was to hold, but Poisson's did
RUBBING = 18  # contacts, joints and brakes with friction (`friction_rows.rubbing_count`)
SENSE = 19  # 1 where forces of what slips agree as those of little friction do, 0 beyond (see `sliding.slide`)
IMPLICIT = 20  # 1 while steps are linearly implicit
STIFF = 21  # steps in turn that look stiff to the explicit method, or not stiff to the implicit one
COUNT_IMPLICIT = 22  # accepted steps since the start that were linearly implicit
COUNT_BACK = 23  # times that the explicit method has been taken again
COUNT_PASSED = 24  # singular configurations that were passed, as far as the engine has computed
IMPLICIT_STEP = 25  # 1 where the engine's own step was linearly implicit that ends at STEP_END
UNDETERMINED = 26  # 1 + what the last choice has left undetermined (`doubts`), 0: nothing
SEVERAL = 27  # 1 + what might have another mode since the last choice, 0: nothing
COUNTERS_LENGTH = 28

# columns of the state's ledger [J]
LEDGER_LOST = 0  # in impacts
LEDGER_LENGTH = 1
