/* FMI 3.0 (specification 3.0.2, chapters 2 to 4): the surface of an instance. */
#include <math.h>
#include <string.h>

#include "fmi3Functions.h"
#include "exchange.h"

/* The standard gives the signatures; what is refused, or needs nothing, leaves arguments unused. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define SELF(c)      \
    Instance *x = c; \
    if (!x) return fmi3Error

/* In a call from within the callback of an intermediate update, only values may be read. */
#define OUTSIDE_UPDATE (~IN(INTERMEDIATE))

OWN_FRAME static void pass_on(const Instance *x, Status status, const char *category, const char *text) {
    /* In a message, # begins the value reference of a variable, and stands for itself when it is doubled. */
    char message[3000];
    size_t n = 0;
    for (; *text && n < sizeof message - 2; text++) {
        if (*text == '#') message[n++] = '#';
        message[n++] = *text;
    }
    message[n] = 0;
    ((fmi3LogMessageCallback)x->logger)(x->environment, (fmi3Status)status, category, message);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

/* --- life --- */

static Instance *instance(const char *name, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
    Instance *x = make_instance(name, 3, NULL, NULL);
    if (!x) return NULL;
    if (log) {
        x->log = pass_on;
        x->logger = (void *)log;
        x->environment = environment;
    }
    x->categories = ~0u; /* a refusal to exist is logged in any case */
    return x;
}

static Status check_token(const Instance *x, const char *call, const char *token) {
    if (token && strcmp(token, model.guid) == 0) return OK;
    return refuse(x,
                  "%s: the instantiation token %s is not this FMU's, %s: modelDescription.xml and binary are not of "
                  "the same build.",
                  call, token ? token : "(null)", model.guid);
}

static Status check_intermediate(const Instance *x, const fmi3ValueReference vr[], size_t count) {
    for (size_t k = 0; vr && k < count; k++) {
        const Variable *v = vr[k] - 1 < model.variable_count ? model.variables + (vr[k] - 1) : NULL;
        if (!v || !v->continuous || v->causality != OUTPUT)
            return refuse(x,
                          "fmi3InstantiateCoSimulation: the required intermediate variable with value reference %u is "
                          "no continuous output (those with intermediateUpdate in modelDescription.xml).",
                          (unsigned)vr[k]);
    }
    return OK;
}

/* A clock ticks in event mode (section 4.2.1): without it, what has one is outside the standard. */
static Status check_event_mode(const Instance *x, int event_mode) {
    if (event_mode || !model.has_clock) return OK;
    return refuse(x, "fmi3InstantiateCoSimulation: this FMU has a clock; use event mode (eventModeUsed = true), or build "
                     "it without --clocks.");
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t required_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback intermediate_update) {
    Instance *x = instance(name, environment, log);
    if (!x) return NULL;
    if (check_token(x, "fmi3InstantiateCoSimulation", token) != OK || check_event_mode(x, event_mode) != OK ||
        check_intermediate(x, required, required_count) != OK) {
        free_instance(x);
        return NULL;
    }
    x->categories = logging ? ~0u : 0;
    x->event_mode = event_mode;
    x->early_return = early_return;
    x->intermediate_update = (void *)intermediate_update;
    return x;
}

static fmi3Instance no_instance(const char *call, const char *missing, const char *name,
                                fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
    Instance *x = instance(name, environment, log);
    if (!x) return NULL;
    refuse(x, "%s: built for co-simulation and Model Exchange; it has no %s interface.", call, missing);
    free_instance(x);
    return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
    Instance *x = instance(name, environment, log);
    if (!x) return NULL;
    if (check_token(x, "fmi3InstantiateModelExchange", token) != OK) {
        free_instance(x);
        return NULL;
    }
    x->categories = logging ? ~0u : 0;
    x->exchange = 1;
    x->head.exchange = 1;
    return x;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
    return no_instance("fmi3InstantiateScheduledExecution", "Scheduled Execution", name, environment, log);
}

void fmi3FreeInstance(fmi3Instance c) {
    if (c && require(c, "fmi3FreeInstance", OUTSIDE_UPDATE) == OK) free_instance(c);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]) {
    SELF(c);
    return (fmi3Status)set_logging(x, on, count, categories);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
                                       fmi3Float64 start_time, fmi3Boolean stop_defined, fmi3Float64 stop_time) {
    const char *call = "fmi3EnterInitializationMode";
    SELF(c);
    if (require(x, call, IN(INSTANTIATED)) != OK) return fmi3Error;
    if (set_up(x, call, start_time, stop_defined, stop_time, tolerance_defined, tolerance) != OK) return fmi3Error;
    x->head.phase = INITIALIZATION;
    return fmi3OK;
}

/* Remember whether there was an impact: then the clock ticks in the event mode that follows. */
static void note_impacts(Instance *x, int64_t count_before) {
    x->head.clock = (x->event_mode || x->exchange) && COUNTERS(x)[CODE_COUNT_IMPACTS] != count_before;
}

/* --- left limits: at an impact, outputs are those before it until fmi3UpdateDiscreteStates --- */

static void keep_left(Instance *x) {
    mechanism_read_outputs(x->block, (int64_t)model.words);
    memcpy(FIELD(x, left_outputs), FIELD(x, outputs), model.outputs * sizeof(double));
    x->outputs_read = 0;
    x->head.left = 1;
}

static int is_before_event(const Instance *x) {
    const double *clock = FIELD(x, clock);
    return COUNTERS(x)[CODE_PENDING_GUARD] != CODE_GUARD_NONE && clock[CODE_TIME] >= clock[CODE_STEP_END];
}

static void forget_left(Instance *x) {
    if (x->head.left) memset(FIELD(x, left_outputs), 0, model.outputs * sizeof(double));
    x->head.left = 0;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
    SELF(c);
    if (require(x, "fmi3ExitInitializationMode", IN(INITIALIZATION)) != OK) return fmi3Error;
    if (initialized(x) != OK) return fmi3Error;
    note_impacts(x, 0);
    if (x->event_mode) x->head.phase = EVENT;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance c) {
    SELF(c);
    if (require(x, "fmi3Terminate", IN(STEPPING) | IN(EVENT) | IN(CONTINUOUS)) != OK) return fmi3Error;
    forget_left(x);
    x->head.phase = TERMINATED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance c) {
    SELF(c);
    if (require(x, "fmi3Reset", OUTSIDE_UPDATE) != OK) return fmi3Error;
    reset(x);
    return fmi3OK;
}

/* --- event mode --- */

fmi3Status fmi3EnterEventMode(fmi3Instance c) {
    SELF(c);
    if (x->exchange) {
        x->head.clock = 0;
        return (fmi3Status)enter_events(x, "fmi3EnterEventMode");
    }
    if (!x->event_mode)
        return (fmi3Status)refuse(x, "fmi3EnterEventMode: the instance was made with eventModeUsed = false.");
    if (require(x, "fmi3EnterEventMode", IN(STEPPING)) != OK) return fmi3Error;
    x->head.phase = EVENT;
    return fmi3OK;
}

/* The engine has found and resolved all events by itself: there is nothing left to iterate. */
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) {
    SELF(c);
    return (fmi3Status)require(x, "fmi3EvaluateDiscreteStates", IN(EVENT));
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *need_update, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
                                    fmi3Boolean *next_event_defined, fmi3Float64 *next_event_time) {
    SELF(c);
    if (require(x, "fmi3UpdateDiscreteStates", IN(EVENT)) != OK) return fmi3Error;
    fmi3Boolean *const flags[] = {need_update, terminate, nominals_changed, states_changed, next_event_defined};
    for (size_t k = 0; k < sizeof flags / sizeof *flags; k++)
        if (flags[k]) *flags[k] = fmi3False;
    if (next_event_time) *next_event_time = INFINITY;
    x->head.clock = 0;
    forget_left(x);
    if (!x->exchange) return fmi3OK;
    EventNews news;
    int64_t impacts = COUNTERS(x)[CODE_COUNT_IMPACTS];
    if (update_events(x, "fmi3UpdateDiscreteStates", &news) != OK) return fmi3Error;
    note_impacts(x, impacts);
    if (need_update) *need_update = x->head.clock != 0; /* the next update ends the clock's tick, which is read before it */
    if (states_changed) *states_changed = news.states_changed != 0;
    if (next_event_defined) *next_event_defined = news.next_time < INFINITY;
    if (next_event_time) *next_event_time = news.next_time;
    return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance c) {
    SELF(c);
    if (x->exchange) return (fmi3Status)refuse(x, "fmi3EnterStepMode: the instance was made for Model Exchange.");
    if (require(x, "fmi3EnterStepMode", IN(EVENT)) != OK) return fmi3Error;
    x->head.phase = STEPPING;
    x->head.clock = 0;
    forget_left(x);
    return fmi3OK;
}

static Status check_clocks(const Instance *x, const fmi3ValueReference vr[], size_t count, const fmi3Clock values[]) {
    if (count > 0 && (!vr || !values)) return refuse(x, "A pointer to value references or clocks is null.");
    for (size_t k = 0; k < count; k++)
        if (!model.has_clock || vr[k] != CLOCK_REFERENCE)
            return refuse(x, "There is no clock with value reference %u.", (unsigned)vr[k]);
    return OK;
}

fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Clock values[]) {
    SELF(c);
    if (check_clocks(x, vr, count, values) != OK) return fmi3Error;
    for (size_t k = 0; k < count; k++)
        values[k] = x->head.phase == EVENT && x->head.clock ? fmi3ClockActive : fmi3ClockInactive;
    return fmi3OK;
}

fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Clock values[]) {
    SELF(c);
    if (check_clocks(x, vr, count, values) != OK) return fmi3Error;
    return count == 0 ? fmi3OK : (fmi3Status)refuse(x, "fmi3SetClock: the clock is an output and cannot be set.");
}

/* --- values --- */

/* Types of variables, with the kind and the layout that they have inside. */
#define VARIABLES(Type, KIND, LAYOUT)                                                                                 \
    fmi3Status fmi3Get##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3##Type values[],        \
                             size_t value_count) {                                                                    \
        SELF(c);                                                                                                      \
        return (fmi3Status)get_values(x, KIND, vr, count, LAYOUT, values, value_count);                               \
    }                                                                                                                 \
    fmi3Status fmi3Set##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3##Type values[],  \
                             size_t value_count) {                                                                    \
        SELF(c);                                                                                                      \
        return (fmi3Status)set_values(x, KIND, vr, count, LAYOUT, values, value_count);                               \
    }

VARIABLES(Float64, REAL, AS_DOUBLE)
VARIABLES(Int32, INTEGER, AS_INT32)
VARIABLES(Boolean, BOOLEAN, AS_BYTE)

/* Types that no variable has. */
#define NO_VARIABLES(Type)                                                                                            \
    fmi3Status fmi3Get##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3##Type values[],        \
                             size_t value_count) {                                                                    \
        return none_of_type(c, #Type, count);                                                                         \
    }                                                                                                                 \
    fmi3Status fmi3Set##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3##Type values[],  \
                             size_t value_count) {                                                                    \
        return none_of_type(c, #Type, count);                                                                         \
    }

static fmi3Status none_of_type(fmi3Instance c, const char *type, size_t count) {
    SELF(c);
    return count == 0 ? fmi3OK : (fmi3Status)refuse(x, "There are no variables of type %s.", type);
}

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
NO_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t count, size_t sizes[],
                         fmi3Binary values[], size_t value_count) {
    return none_of_type(c, "Binary", count);
}

fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const size_t sizes[],
                         const fmi3Binary values[], size_t value_count) {
    return none_of_type(c, "Binary", count);
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count) {
    SELF(c);
    unsigned allowed = IN(STEPPING) | IN(EVENT) | IN(INTERMEDIATE) | IN(TERMINATED);
    if (require(x, "fmi3GetOutputDerivatives", allowed) != OK) return fmi3Error;
    return (fmi3Status)get_rates(x, vr, count, orders, values, value_count);
}

/* --- state --- */

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) {
    SELF(c);
    if (require(x, "fmi3GetFMUState", OUTSIDE_UPDATE) != OK) return fmi3Error;
    if (!state) return (fmi3Status)refuse(x, "fmi3GetFMUState: the pointer is null.");
    return (fmi3Status)save(x, (Saved **)state);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
    SELF(c);
    if (require(x, "fmi3SetFMUState", OUTSIDE_UPDATE) != OK) return fmi3Error;
    return (fmi3Status)restore(x, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) {
    SELF(c);
    if (state) {
        free_saved(x, *state);
        *state = NULL;
    }
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) {
    SELF(c);
    if (!size) return (fmi3Status)refuse(x, "fmi3SerializedFMUStateSize: the pointer to the size is null.");
    *size = serialized_size();
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
    SELF(c);
    return (fmi3Status)serialize(x, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
    SELF(c);
    if (!state) return (fmi3Status)refuse(x, "fmi3DeserializeFMUState: the pointer is null.");
    return (fmi3Status)deserialize(x, bytes, size, (Saved **)state);
}

/* --- co-simulation --- */

/* Let the host look at what has been reached; returns where the step shall end: at `end`, or where the host wants to
 * have it back, but never in the past. Inputs cannot be set there: each of the engine's steps would begin anew. */
static double intermediate_update(Instance *x, double end) {
    double now = time_of(x);
    fmi3Boolean requested = fmi3False;
    fmi3Float64 wanted = now;
    x->head.phase = INTERMEDIATE;
    ((fmi3IntermediateUpdateCallback)x->intermediate_update)(x->environment, now, fmi3False, fmi3True, fmi3True,
                                                             x->early_return != 0, &requested, &wanted);
    x->head.phase = STEPPING;
    if (!requested || !x->early_return || wanted >= end) return end;
    return fmax(now, wanted);
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 current_time, fmi3Float64 size, fmi3Boolean no_way_back,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached) {
    SELF(c);
    double target;
    if (!event || !terminate || !early || !reached)
        return (fmi3Status)refuse(x, "fmi3DoStep: a pointer for a result is null.");
    if (require(x, "fmi3DoStep", IN(STEPPING)) != OK) return fmi3Error;
    if (step_target(x, "fmi3DoStep", current_time, size, &target) != OK) return fmi3Error;
    const int64_t *impacts = COUNTERS(x) + CODE_COUNT_IMPACTS, before = *impacts;
    int64_t events_before = COUNTERS(x)[CODE_COUNT_EVENTS];
    int stops = x->event_mode && x->early_return;
    int64_t rule = (x->intermediate_update ? CODE_STOP_AT_STEP : 0) | (x->event_mode ? CODE_STOP_BEFORE_EVENT : 0);
    double begun = time_of(x);
    double end = target; /* sooner when the host asks for it at an intermediate update */
    forget_left(x);
    Status status = begin_step(x, target);
    while (status == OK && time_of(x) < end && !(stops && *impacts != before)) {
        status = go_on(x, end, rule);
        if (status == OK && x->intermediate_update) end = intermediate_update(x, end);
        if (status == OK && x->event_mode && is_before_event(x)) {
            int64_t seen = *impacts;
            keep_left(x);
            status = go_on(x, end, CODE_STOP_AT_STEP);
            /* What lies within the step is over when the host reads. */
            if (*impacts == seen || (!stops && time_of(x) < target)) forget_left(x);
        }
    }
    log_news(x);
    note_impacts(x, before);
    /* What has no more internal steps ends early where the host allows that, and is discarded where not. */
    if (status == DISCARD && x->early_return && time_of(x) > begun) status = OK;
    /* Discrete outputs change at any event; only impacts make the clock tick, and the step end early. */
    *event = x->event_mode && COUNTERS(x)[CODE_COUNT_EVENTS] != events_before;
    *terminate = fmi3False;
    *early = status == OK && time_of(x) < target;
    *reached = time_of(x);
    return (fmi3Status)status;
}

/* --- Model Exchange --- */

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) {
    SELF(c);
    x->head.clock = 0;
    return (fmi3Status)enter_continuous(x, "fmi3EnterContinuousTimeMode");
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean no_way_back, fmi3Boolean *enter_event_mode,
                                       fmi3Boolean *terminate) {
    SELF(c);
    int wants_events = 0;
    Status status = complete_step(x, "fmi3CompletedIntegratorStep", &wants_events);
    if (enter_event_mode) *enter_event_mode = wants_events != 0;
    if (terminate) *terminate = fmi3False;
    return (fmi3Status)status;
}

fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time) {
    SELF(c);
    return (fmi3Status)set_instant(x, "fmi3SetTime", time);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 states[], size_t count) {
    SELF(c);
    return (fmi3Status)set_states(x, "fmi3SetContinuousStates", states, count);
}

/* Calls that give one number for each state or indicator. */
#define NUMBERS(Get, function)                                                     \
    fmi3Status fmi3##Get(fmi3Instance c, fmi3Float64 numbers[], size_t count) {    \
        SELF(c);                                                                   \
        return (fmi3Status)function(x, "fmi3" #Get, numbers, count);               \
    }

NUMBERS(GetContinuousStateDerivatives, get_derivatives)
NUMBERS(GetEventIndicators, get_indicators)
NUMBERS(GetContinuousStates, get_states)
NUMBERS(GetNominalsOfContinuousStates, get_nominals)

static fmi3Status give_count(const Instance *x, const char *call, size_t *count, size_t value) {
    if (!count) return (fmi3Status)refuse(x, "%s: the pointer is null.", call);
    *count = value;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *count) {
    SELF(c);
    return give_count(x, "fmi3GetNumberOfEventIndicators", count, SIZE(x, indicators));
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *count) {
    SELF(c);
    return give_count(x, "fmi3GetNumberOfContinuousStates", count, SIZE(x, unknowns));
}

/* --- directional derivatives --- */

static Status check_counts(const Instance *x, const char *call, size_t references, size_t numbers) {
    if (references == numbers) return OK;
    return refuse(x, "%s: %zu numbers for %zu variables, all of which are scalars.", call, numbers, references);
}

#define DERIVATIVE(Name, function, seeded, valued)                                                                     \
    fmi3Status fmi3Get##Name(fmi3Instance c, const fmi3ValueReference unknown[], size_t unknowns,                      \
                             const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[], size_t seeds,  \
                             fmi3Float64 value[], size_t values) {                                                     \
        SELF(c);                                                                                                       \
        if (check_counts(x, "fmi3Get" #Name, seeded, seeds) != OK || check_counts(x, "fmi3Get" #Name, valued, values)) \
            return fmi3Error;                                                                                          \
        return (fmi3Status)function(x, "fmi3Get" #Name, unknown, unknowns, known, knowns, seed, value);                \
    }

DERIVATIVE(DirectionalDerivative, directional, knowns, unknowns)
DERIVATIVE(AdjointDerivative, adjoint, unknowns, knowns)

/* --- what this FMU does not have --- */

#define REFUSES(function, why, ...)                            \
    fmi3Status function(fmi3Instance c, __VA_ARGS__) {         \
        SELF(c);                                               \
        return (fmi3Status)refuse(x, #function ": " why);      \
    }
#define REFUSES_ALONE(function, why)                           \
    fmi3Status function(fmi3Instance c) {                      \
        SELF(c);                                               \
        return (fmi3Status)refuse(x, #function ": " why);      \
    }

#define NO_ELEMENTS "dependencies are in modelDescription.xml; those of elements are not provided."
#define NO_STRUCTURE "there are no structural parameters."
#define NO_INTERVALS "the clock is triggered by impacts and has no interval or shift."

REFUSES(fmi3GetNumberOfVariableDependencies, NO_ELEMENTS, fmi3ValueReference vr, size_t *count)
REFUSES(fmi3GetVariableDependencies, NO_ELEMENTS, fmi3ValueReference dependent, size_t dependent_elements[],
        fmi3ValueReference independents[], size_t independent_elements[], fmi3DependencyKind kinds[], size_t count)
REFUSES_ALONE(fmi3EnterConfigurationMode, NO_STRUCTURE)
REFUSES_ALONE(fmi3ExitConfigurationMode, NO_STRUCTURE)
REFUSES(fmi3GetIntervalDecimal, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, fmi3Float64 intervals[],
        fmi3IntervalQualifier qualifiers[])
REFUSES(fmi3GetIntervalFraction, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, fmi3UInt64 counters[],
        fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
REFUSES(fmi3GetShiftDecimal, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, fmi3Float64 shifts[])
REFUSES(fmi3GetShiftFraction, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, fmi3UInt64 counters[],
        fmi3UInt64 resolutions[])
REFUSES(fmi3SetIntervalDecimal, NO_INTERVALS, const fmi3ValueReference vr[], size_t count,
        const fmi3Float64 intervals[])
REFUSES(fmi3SetIntervalFraction, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, const fmi3UInt64 counters[],
        const fmi3UInt64 resolutions[])
REFUSES(fmi3SetShiftDecimal, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, const fmi3Float64 shifts[])
REFUSES(fmi3SetShiftFraction, NO_INTERVALS, const fmi3ValueReference vr[], size_t count, const fmi3UInt64 counters[],
        const fmi3UInt64 resolutions[])

REFUSES(fmi3ActivateModelPartition, "there is no Scheduled Execution interface.",
        fmi3ValueReference clock, fmi3Float64 activation_time)
