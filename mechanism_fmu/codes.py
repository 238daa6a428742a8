"""Integer codes shared by the tables (written by `model`) and the engine (which reads them).

Plain integers, because compiled code freezes module-level integers as constants.
"""

# joint_kind
REVOLUTE = 0
TRANSLATIONAL = 1

# force_kind
TORQUE = 0
TORSION_SPRING = 1

# force_data columns
TORQUE_VALUE = 0
SPRING_STIFFNESS = 0
SPRING_FREE_ANGLE = 1
SPRING_PRELOAD = 2

# contact_mode (state) and contact_start_mode (tables)
OPEN = 0
CLOSED = 1

# settings columns
RELATIVE_TOLERANCE = 0
BAUMGARTE_ALPHA = 1
BAUMGARTE_BETA = 2

# output_kind: what an output reads; output_index says of which, output_slot of which buffered impact
CONSTANT = 0
COORDINATE = 1
RATE = 2
CONTACT_FORCE = 3
CONTACT_GAP = 4
KINETIC_ENERGY = 5
SPRING_ENERGY = 6
WORK_DONE = 7
ENERGY_LOST = 8
IMPACT_COUNT = 9
IMPACTS_IN_STEP = 10
IMPACTS_LOST = 11
IMPACT_FLAG = 12
LAST_IMPACT = 13
BUFFERED_IMPACT = 14

# columns of an impact record; behind them: impulse of every contact, then all rates before, then after
RECORD_TIME = 0
RECORD_CONTACT = 1
RECORD_TOOTH = 2
RECORD_CLOSING_SPEED = 3
RECORD_IMPULSE = 4
RECORD_VELOCITY = 5
RECORD_CONTACT_IMPULSES = 6

#: Impacts of one communication step that are kept, oldest first.
IMPACT_BUFFER_LENGTH = 8

# columns of the state's clock [s]
TIME = 0  # up to which the outside has come
STEP_START = 1  # the engine's own step, which may reach beyond TIME
STEP_END = 2
STEP_SIZE = 3
NEXT_STEP = 4
CLOCK_LENGTH = 5

# columns of the state's counters
COUNT_IMPACTS = 0
COUNT_IN_STEP = 1
COUNT_LOST = 2
COUNT_STEPS = 3  # accepted steps since the start
PENDING_CONTACT = 4  # contact whose impact waits at STEP_END, or NO_CONTACT
COUNT_PULLS = 5  # closed contacts that have pulled, as far as the engine has computed
COUNTERS_LENGTH = 6
NO_CONTACT = -1

# columns of the state's ledger [J]
LEDGER_LOST = 0
LEDGER_LENGTH = 1
