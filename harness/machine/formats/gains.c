/* An FMU (FMI 2.0 for co-simulation) whose outputs are factor * input + offset at every instant; nothing moves in it.
   Channel k has the value references 4 k (input), 4 k + 1 (output), 4 k + 2 (factor) and 4 k + 3 (offset).
   given.h has its GUID, and what the first factors and offsets are before anybody sets them; others are 1 and 0. */
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "given.h"

#define CHANNELS 256

enum Place { IN, OUT, FACTOR, OFFSET };

typedef struct {
    double of[CHANNELS][4];
} Gains;

static void begin(Gains *x) {
    memset(x, 0, sizeof *x);
    for (int k = 0; k < CHANNELS; k++) x->of[k][FACTOR] = 1.0;
    for (int k = 0; k < GIVEN; k++) {
        x->of[k][FACTOR] = given[k][0];
        x->of[k][OFFSET] = given[k][1];
    }
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *host, fmi2Boolean visible, fmi2Boolean logging) {
    (void)name, (void)resources, (void)host, (void)visible, (void)logging;
    if (type != fmi2CoSimulation || !guid || strcmp(guid, GUID) != 0) return NULL;
    Gains *x = malloc(sizeof *x);
    if (x) begin(x);
    return x;
}

void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2Reset(fmi2Component c) {
    begin(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
    const Gains *x = c;
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= 4 * CHANNELS) return fmi2Error;
        const double *of = x->of[vr[i] / 4];
        value[i] = vr[i] % 4 == OUT ? of[FACTOR] * of[IN] + of[OFFSET] : of[vr[i] % 4];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]) {
    Gains *x = c;
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= 4 * CHANNELS || vr[i] % 4 == OUT) return fmi2Error;
        x->of[vr[i] / 4][vr[i] % 4] = value[i];
    }
    return fmi2OK;
}

/* The state is all numbers. */
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    if (!*state) *state = malloc(sizeof(Gains));
    if (!*state) return fmi2Error;
    memcpy(*state, c, sizeof(Gains));
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    memcpy(c, state, sizeof(Gains));
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    (void)c;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

/* What needs nothing done. */
#define NOTHING(name, ...) \
    fmi2Status name(__VA_ARGS__) { return fmi2OK; }
NOTHING(fmi2SetDebugLogging, fmi2Component c __attribute__((unused)), fmi2Boolean on __attribute__((unused)),
        size_t n __attribute__((unused)), const fmi2String names[] __attribute__((unused)))
NOTHING(fmi2SetupExperiment, fmi2Component c __attribute__((unused)), fmi2Boolean d __attribute__((unused)),
        fmi2Real t __attribute__((unused)), fmi2Real a __attribute__((unused)), fmi2Boolean e __attribute__((unused)),
        fmi2Real b __attribute__((unused)))
NOTHING(fmi2EnterInitializationMode, fmi2Component c __attribute__((unused)))
NOTHING(fmi2ExitInitializationMode, fmi2Component c __attribute__((unused)))
NOTHING(fmi2Terminate, fmi2Component c __attribute__((unused)))
NOTHING(fmi2DoStep, fmi2Component c __attribute__((unused)), fmi2Real t __attribute__((unused)),
        fmi2Real h __attribute__((unused)), fmi2Boolean keep __attribute__((unused)))

/* What there is none of. */
#define NONE(name, ...) \
    fmi2Status name(__VA_ARGS__) { return fmi2Error; }
#define REFERENCES fmi2Component c __attribute__((unused)), const fmi2ValueReference vr[] __attribute__((unused)), \
                   size_t n __attribute__((unused))
#define KIND fmi2Component c __attribute__((unused)), const fmi2StatusKind kind __attribute__((unused))
NONE(fmi2GetInteger, REFERENCES, fmi2Integer value[] __attribute__((unused)))
NONE(fmi2GetBoolean, REFERENCES, fmi2Boolean value[] __attribute__((unused)))
NONE(fmi2GetString, REFERENCES, fmi2String value[] __attribute__((unused)))
NONE(fmi2SetInteger, REFERENCES, const fmi2Integer value[] __attribute__((unused)))
NONE(fmi2SetBoolean, REFERENCES, const fmi2Boolean value[] __attribute__((unused)))
NONE(fmi2SetString, REFERENCES, const fmi2String value[] __attribute__((unused)))
NONE(fmi2SetRealInputDerivatives, REFERENCES, const fmi2Integer order[] __attribute__((unused)),
     const fmi2Real value[] __attribute__((unused)))
NONE(fmi2GetRealOutputDerivatives, REFERENCES, const fmi2Integer order[] __attribute__((unused)),
     fmi2Real value[] __attribute__((unused)))
NONE(fmi2GetDirectionalDerivative, REFERENCES, const fmi2ValueReference known[] __attribute__((unused)),
     size_t m __attribute__((unused)), const fmi2Real d[] __attribute__((unused)),
     fmi2Real value[] __attribute__((unused)))
NONE(fmi2SerializedFMUstateSize, fmi2Component c __attribute__((unused)), fmi2FMUstate s __attribute__((unused)),
     size_t *size __attribute__((unused)))
NONE(fmi2SerializeFMUstate, fmi2Component c __attribute__((unused)), fmi2FMUstate s __attribute__((unused)),
     fmi2Byte bytes[] __attribute__((unused)), size_t size __attribute__((unused)))
NONE(fmi2DeSerializeFMUstate, fmi2Component c __attribute__((unused)), const fmi2Byte bytes[] __attribute__((unused)),
     size_t size __attribute__((unused)), fmi2FMUstate *s __attribute__((unused)))
NONE(fmi2CancelStep, fmi2Component c __attribute__((unused)))
NONE(fmi2GetStatus, KIND, fmi2Status *value __attribute__((unused)))
NONE(fmi2GetRealStatus, KIND, fmi2Real *value __attribute__((unused)))
NONE(fmi2GetIntegerStatus, KIND, fmi2Integer *value __attribute__((unused)))
NONE(fmi2GetBooleanStatus, KIND, fmi2Boolean *value __attribute__((unused)))
NONE(fmi2GetStringStatus, KIND, fmi2String *value __attribute__((unused)))
