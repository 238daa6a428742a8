/* The calls of FMI 3.0, with event mode and early return. */
#include <stdlib.h>

#include "fmi3FunctionTypes.h"
#include "host.h"

#define FUNCTIONS(use)                                                                                                \
    use(InstantiateCoSimulation) use(FreeInstance) use(EnterInitializationMode) use(ExitInitializationMode)           \
    use(DoStep) use(EnterEventMode) use(UpdateDiscreteStates) use(EnterStepMode) use(SetFloat64) use(SetInt32)        \
    use(SetBoolean) use(GetFloat64) use(GetInt32) use(GetBoolean) use(Reset) use(Terminate) use(GetFMUState)          \
    use(SetFMUState) use(FreeFMUState) use(SerializedFMUStateSize) use(SerializeFMUState) use(DeserializeFMUState)

#define DECLARE(name) static fmi3##name##TYPE *name;
#define BIND(name) name = (fmi3##name##TYPE *)function("fmi3" #name);

FUNCTIONS(DECLARE)

int early_returns = 0;

void bind_functions(void) { FUNCTIONS(BIND) }

static void logger(void *environment, fmi3Status status, fmi3String category, fmi3String text) {
    (void)environment, (void)status;
    told(category, "%s", text);
}

void *make(const char *name, const char *token, const char *resources) {
    return InstantiateCoSimulation(name, token, resources, false, true, true, true, NULL, 0, NULL, logger, NULL);
}

void release(void *x) { FreeInstance(x); }

static int leave_event_mode(void *x) {
    fmi3Boolean flags[5];
    fmi3Float64 next;
    fmi3Status status = UpdateDiscreteStates(x, flags, flags + 1, flags + 2, flags + 3, flags + 4, &next);
    return status < fmi3Discard ? EnterStepMode(x) : status;
}

int begin(void *x) {
    fmi3Status status = EnterInitializationMode(x, false, 0, 0, false, 0);
    if (status < fmi3Discard) status = ExitInitializationMode(x);
    return status < fmi3Discard ? leave_event_mode(x) : (int)status;
}

int step(void *x, double *time, double size) {
    const double end = *time + size;
    fmi3Boolean event, ended, early = false;
    fmi3Float64 reached;
    do {
        fmi3Status status = DoStep(x, *time, early ? end - *time : size, true, &event, &ended, &early, &reached);
        if (status >= fmi3Discard) return status;
        *time = reached;
        if (!event) continue;
        if ((status = EnterEventMode(x)) >= fmi3Discard) return status;
        if ((status = leave_event_mode(x)) >= fmi3Discard) return status;
    } while (early && (early_returns++, *time < end));
    *time = end;
    return fmi3OK;
}

int set_value(void *x, char kind, unsigned reference, double value) {
    fmi3Int32 whole = (fmi3Int32)value;
    fmi3Boolean truth = value != 0;
    if (kind == 'r') return SetFloat64(x, &reference, 1, &value, 1);
    if (kind == 'i') return SetInt32(x, &reference, 1, &whole, 1);
    return SetBoolean(x, &reference, 1, &truth, 1);
}

int get_value(void *x, char kind, unsigned reference, double *value) {
    fmi3Int32 whole = 0;
    fmi3Boolean truth = false;
    if (kind == 'r') return GetFloat64(x, &reference, 1, value, 1);
    fmi3Status status = kind == 'i' ? GetInt32(x, &reference, 1, &whole, 1) : GetBoolean(x, &reference, 1, &truth, 1);
    *value = kind == 'i' ? whole : truth;
    return status;
}

int reset(void *x) { return Reset(x); }
int terminate(void *x) { return Terminate(x); }
int save(void *x, void **state) { return GetFMUState(x, state); }
int restore(void *x, void *state) { return SetFMUState(x, state); }
int forget(void *x, void **state) { return FreeFMUState(x, state); }
int size_of(void *x, void *state, size_t *size) { return SerializedFMUStateSize(x, state, size); }
int to_bytes(void *x, void *state, char *bytes, size_t size) {
    return SerializeFMUState(x, state, (fmi3Byte *)bytes, size);
}
int from_bytes(void *x, const char *bytes, size_t size, void **state) {
    return DeserializeFMUState(x, (const fmi3Byte *)bytes, size, state);
}
