/* The calls of FMI 2.0. */
#include <stdlib.h>

#include "fmi2FunctionTypes.h"
#include "host.h"

#define FUNCTIONS(use)                                                                                                \
    use(Instantiate) use(FreeInstance) use(SetupExperiment) use(EnterInitializationMode) use(ExitInitializationMode)  \
    use(DoStep) use(SetReal) use(SetInteger) use(SetBoolean) use(GetReal) use(GetInteger) use(GetBoolean) use(Reset)  \
    use(Terminate) use(GetFMUstate) use(SetFMUstate) use(FreeFMUstate) use(SerializedFMUstateSize)                    \
    use(SerializeFMUstate) use(DeSerializeFMUstate)

#define DECLARE(name) static fmi2##name##TYPE *name;
#define BIND(name) name = (fmi2##name##TYPE *)function("fmi2" #name);

FUNCTIONS(DECLARE)

int early_returns = 0;

void bind_functions(void) { FUNCTIONS(BIND) }

/* The text is a printf format whose arguments follow; none of ours has any, but % doubled. */
static void logger(void *environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...) {
    (void)environment, (void)name, (void)status;
    told(category, text);
}

static const fmi2CallbackFunctions CALLBACKS = {(fmi2CallbackLogger)logger, calloc, free, NULL, NULL};

void *make(const char *name, const char *token, const char *resources) {
    return Instantiate(name, fmi2CoSimulation, token, resources, &CALLBACKS, fmi2False, fmi2True);
}

void release(void *x) { FreeInstance(x); }

int begin(void *x) {
    fmi2Status status = SetupExperiment(x, fmi2False, 0, 0, fmi2False, 0);
    if (status < fmi2Discard) status = EnterInitializationMode(x);
    return status < fmi2Discard ? ExitInitializationMode(x) : status;
}

int step(void *x, double *time, double size) {
    fmi2Status status = DoStep(x, *time, size, fmi2True);
    if (status < fmi2Discard) *time += size;
    return status;
}

int set_value(void *x, char kind, unsigned reference, double value) {
    int whole = (int)value;
    if (kind == 'r') return SetReal(x, &reference, 1, &value);
    return (kind == 'i' ? SetInteger : SetBoolean)(x, &reference, 1, &whole);
}

int get_value(void *x, char kind, unsigned reference, double *value) {
    int whole = 0;
    if (kind == 'r') return GetReal(x, &reference, 1, value);
    fmi2Status status = (kind == 'i' ? GetInteger : GetBoolean)(x, &reference, 1, &whole);
    *value = whole;
    return status;
}

int reset(void *x) { return Reset(x); }
int terminate(void *x) { return Terminate(x); }
int save(void *x, void **state) { return GetFMUstate(x, state); }
int restore(void *x, void *state) { return SetFMUstate(x, state); }
int forget(void *x, void **state) { return FreeFMUstate(x, state); }
int size_of(void *x, void *state, size_t *size) { return SerializedFMUstateSize(x, state, size); }
int to_bytes(void *x, void *state, char *bytes, size_t size) { return SerializeFMUstate(x, state, bytes, size); }
int from_bytes(void *x, const char *bytes, size_t size, void **state) {
    return DeSerializeFMUstate(x, bytes, size, state);
}
