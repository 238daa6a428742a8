/* FMI 2.0 (specification 2.0.4, chapters 2 to 4): the surface of an instance. */
#include <math.h>
#include <string.h>

#include "fmi2Functions.h"
#include "exchange.h"

#define SELF(c)             \
    Instance *x = c;        \
    if (!x) return fmi2Error

OWN_FRAME static void pass_on(const Instance *x, Status status, const char *category, const char *text) {
    /* The logger takes a printf format, in which % must be doubled. */
    char format[3000];
    size_t n = 0;
    for (; *text && n < sizeof format - 2; text++) {
        if (*text == '%') format[n++] = '%';
        format[n++] = *text;
    }
    format[n] = 0;
    ((fmi2CallbackLogger)x->logger)(x->environment, x->name, (fmi2Status)status, category, format);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *host, fmi2Boolean visible, fmi2Boolean logging) {
    (void)resources, (void)visible;
    Instance *x = make_instance(name, 2, host ? host->allocateMemory : NULL, host ? host->freeMemory : NULL);
    if (!x) return NULL;
    if (host && host->logger) {
        x->log = pass_on;
        x->logger = (void *)host->logger;
        x->environment = host->componentEnvironment;
    }
    x->categories = ~0u; /* a refusal to exist is logged in any case */
    Status status = OK;
    if (!guid || strcmp(guid, model.guid) != 0)
        status = refuse(x,
                        "fmi2Instantiate: the GUID %s is not this FMU's, %s: modelDescription.xml and binary are not of "
                        "the same build.",
                        guid ? guid : "(null)", model.guid);
    if (status != OK) {
        free_instance(x);
        return NULL;
    }
    x->categories = logging ? ~0u : 0;
    x->exchange = type == fmi2ModelExchange;
    x->head.exchange = x->exchange;
    return x;
}

void fmi2FreeInstance(fmi2Component c) {
    if (c) free_instance(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
    SELF(c);
    return (fmi2Status)set_logging(x, on, count, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start_time,
                               fmi2Boolean stop_defined, fmi2Real stop_time) {
    SELF(c);
    if (require(x, "fmi2SetupExperiment", IN(INSTANTIATED)) != OK) return fmi2Error;
    return (fmi2Status)set_up(x, "fmi2SetupExperiment", start_time, stop_defined, stop_time, tolerance_defined, tolerance);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    SELF(c);
    if (require(x, "fmi2EnterInitializationMode", IN(INSTANTIATED)) != OK) return fmi2Error;
    if (!x->head.set_up)
        return (fmi2Status)refuse(x, "fmi2EnterInitializationMode is not allowed before fmi2SetupExperiment.");
    x->head.phase = INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    SELF(c);
    if (require(x, "fmi2ExitInitializationMode", IN(INITIALIZATION)) != OK) return fmi2Error;
    return (fmi2Status)initialized(x);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    SELF(c);
    unsigned running = x->exchange ? IN(EVENT) | IN(CONTINUOUS) : IN(STEPPING);
    if (require(x, "fmi2Terminate", running) != OK) return fmi2Error;
    x->head.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
    SELF(c);
    reset(x);
    return fmi2OK;
}

/* --- values --- */

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[]) {
    SELF(c);
    return (fmi2Status)get_values(x, REAL, vr, count, AS_DOUBLE, value, count);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Integer value[]) {
    SELF(c);
    return (fmi2Status)get_values(x, INTEGER, vr, count, AS_INT32, value, count);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Boolean value[]) {
    SELF(c);
    return (fmi2Status)get_values(x, BOOLEAN, vr, count, AS_INT32, value, count);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[]) {
    SELF(c);
    return (fmi2Status)set_values(x, REAL, vr, count, AS_DOUBLE, value, count);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer value[]) {
    SELF(c);
    return (fmi2Status)set_values(x, INTEGER, vr, count, AS_INT32, value, count);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Boolean value[]) {
    SELF(c);
    return (fmi2Status)set_values(x, BOOLEAN, vr, count, AS_INT32, value, count);
}

static fmi2Status no_strings(const Instance *x, size_t count) {
    return count == 0 ? fmi2OK : (fmi2Status)refuse(x, "There are no variables of type String.");
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2String value[]) {
    SELF(c);
    (void)vr, (void)value;
    return no_strings(x, count);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2String value[]) {
    SELF(c);
    (void)vr, (void)value;
    return no_strings(x, count);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns,
                                        const fmi2ValueReference known[], size_t knowns, const fmi2Real seed[],
                                        fmi2Real value[]) {
    SELF(c);
    return (fmi2Status)directional(x, "fmi2GetDirectionalDerivative", unknown, unknowns, known, knowns, seed, value);
}

/* --- state --- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    SELF(c);
    if (!state) return (fmi2Status)refuse(x, "fmi2GetFMUstate: the pointer is null.");
    return (fmi2Status)save(x, (Saved **)state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    SELF(c);
    return (fmi2Status)restore(x, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    SELF(c);
    if (state) {
        free_saved(x, *state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    SELF(c);
    (void)state;
    if (!size) return (fmi2Status)refuse(x, "fmi2SerializedFMUstateSize: the pointer to the size is null.");
    *size = serialized_size();
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    SELF(c);
    return (fmi2Status)serialize(x, state, (unsigned char *)bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
    SELF(c);
    if (!state) return (fmi2Status)refuse(x, "fmi2DeSerializeFMUstate: the pointer is null.");
    return (fmi2Status)deserialize(x, (const unsigned char *)bytes, size, (Saved **)state);
}

/* --- Model Exchange --- */

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    SELF(c);
    return (fmi2Status)enter_events(x, "fmi2EnterEventMode");
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
    SELF(c);
    EventNews news;
    if (!info) return (fmi2Status)refuse(x, "fmi2NewDiscreteStates: the pointer is null.");
    if (update_events(x, "fmi2NewDiscreteStates", &news) != OK) return fmi2Error;
    *info = (fmi2EventInfo){.valuesOfContinuousStatesChanged = news.states_changed,
                            .nextEventTimeDefined = news.next_time < INFINITY,
                            .nextEventTime = news.next_time};
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    SELF(c);
    return (fmi2Status)enter_continuous(x, "fmi2EnterContinuousTimeMode");
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_way_back, fmi2Boolean *enter_event_mode,
                                       fmi2Boolean *terminate) {
    SELF(c);
    (void)no_way_back;
    int wants_events = 0;
    Status status = complete_step(x, "fmi2CompletedIntegratorStep", &wants_events);
    if (enter_event_mode) *enter_event_mode = wants_events;
    if (terminate) *terminate = fmi2False;
    return (fmi2Status)status;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    SELF(c);
    return (fmi2Status)set_instant(x, "fmi2SetTime", time);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real states[], size_t count) {
    SELF(c);
    return (fmi2Status)set_states(x, "fmi2SetContinuousStates", states, count);
}

/* Calls that give one number for each state or indicator. */
#define NUMBERS(Get, function)                                                  \
    fmi2Status fmi2##Get(fmi2Component c, fmi2Real numbers[], size_t count) {   \
        SELF(c);                                                                \
        return (fmi2Status)function(x, "fmi2" #Get, numbers, count);            \
    }

NUMBERS(GetDerivatives, get_derivatives)
NUMBERS(GetEventIndicators, get_indicators)
NUMBERS(GetContinuousStates, get_states)
NUMBERS(GetNominalsOfContinuousStates, get_nominals)

/* --- co-simulation --- */

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    SELF(c);
    if (require(x, "fmi2SetRealInputDerivatives", IN(INITIALIZATION) | IN(STEPPING)) != OK) return fmi2Error;
    return (fmi2Status)set_slopes(x, vr, count, order, value);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                        const fmi2Integer order[], fmi2Real value[]) {
    SELF(c);
    if (require(x, "fmi2GetRealOutputDerivatives", IN(STEPPING) | IN(TERMINATED)) != OK) return fmi2Error;
    return (fmi2Status)get_rates(x, vr, count, order, value, count);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real current_time, fmi2Real size, fmi2Boolean no_way_back) {
    SELF(c);
    (void)no_way_back;
    double target;
    if (require(x, "fmi2DoStep", IN(STEPPING)) != OK) return fmi2Error;
    if (step_target(x, "fmi2DoStep", current_time, size, &target) != OK) return fmi2Error;
    Status status = begin_step(x, target);
    if (status == OK) status = go_on(x, target, CODE_STOP_AT_TARGET);
    log_news(x);
    return (fmi2Status)status;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    SELF(c);
    return (fmi2Status)refuse(x, "fmi2CancelStep: no step is under way; every step ends before fmi2DoStep returns.");
}

static fmi2Status no_pending(const Instance *x, const char *call) {
    return (fmi2Status)refuse(x, "%s: no step is ever pending, so there is no such status.", call);
}

/* Kinds of status that there are while a step is pending only. */
#define ONLY_PENDING(Get, Type)                                                                  \
    fmi2Status fmi2##Get(fmi2Component c, const fmi2StatusKind kind, Type *value) {              \
        SELF(c);                                                                                 \
        (void)kind, (void)value;                                                                 \
        return no_pending(x, "fmi2" #Get);                                                       \
    }

ONLY_PENDING(GetStatus, fmi2Status)
ONLY_PENDING(GetIntegerStatus, fmi2Integer)
ONLY_PENDING(GetStringStatus, fmi2String)

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    SELF(c);
    if (kind != fmi2LastSuccessfulTime)
        return (fmi2Status)refuse(x, "fmi2GetRealStatus knows fmi2LastSuccessfulTime only.");
    if (!value) return (fmi2Status)refuse(x, "fmi2GetRealStatus: the pointer to the value is null.");
    *value = time_of(x);
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    SELF(c);
    if (kind != fmi2Terminated) return no_pending(x, "fmi2GetBooleanStatus");
    if (!value) return (fmi2Status)refuse(x, "fmi2GetBooleanStatus: the pointer to the value is null.");
    *value = fmi2False; /* the mechanism never asks for the end of the simulation */
    return fmi2OK;
}
