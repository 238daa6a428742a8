/* Foreign FMUs of FMI 3.0 for Model Exchange only; the instantiation token says which one.
 *
 * bouncing: a ball; 1 h, 2 v, 3 der(h), 4 der(v), 5 e (parameter), 6 bounces (Int32), 7 event indicator. Below 1 mm/s it
 * rests. van_der_pol: 1 x0, 2 x1, 3 der(x0), 4 der(x1). stair: 6 counter (Int32), one step each second, by time events.
 * Functions that it has no use for are added by in_c.py. */
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { OK = 0, DISCARD = 2, ERROR = 3, BOUNCING, VAN_DER_POL, STAIR };
enum { BEFORE, EVENTS, CONTINUOUS };

typedef struct {
    int kind, mode;
    bool told;
    double time, x[2], e, g;
    int32_t count;
} Foreign;

const char *fmi3GetVersion(void) { return "3.0"; }

int fmi3Reset(Foreign *f) {
    int kind = f->kind;
    *f = (Foreign){.kind = kind, .e = 0.7, .g = -9.81};
    f->x[0] = kind == STAIR ? 0 : kind == BOUNCING ? 1 : 2;
    return OK;
}

void *fmi3InstantiateModelExchange(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                   void *environment, void *log) {
    Foreign *f = calloc(1, sizeof *f);
    f->kind = !strcmp(token, "bouncing") ? BOUNCING : !strcmp(token, "stair") ? STAIR : VAN_DER_POL;
    fmi3Reset(f);
    return f;
}

void fmi3FreeInstance(Foreign *f) { free(f); }

int fmi3EnterInitializationMode(Foreign *f, bool tolerance_defined, double tolerance, double start, bool stop_defined,
                                double stop) {
    f->time = start;
    return OK;
}

int fmi3ExitInitializationMode(Foreign *f) {
    f->mode = EVENTS;
    return OK;
}

int fmi3EnterEventMode(Foreign *f) {
    if (f->mode != CONTINUOUS) return ERROR;
    f->mode = EVENTS;
    return OK;
}

int fmi3UpdateDiscreteStates(Foreign *f, bool *again, bool *terminate, bool *nominals, bool *values, bool *announces,
                             double *when) {
    if (f->mode != EVENTS) return ERROR;
    *again = *terminate = *nominals = *values = *announces = false;
    if (f->kind == BOUNCING && f->x[0] <= 0 && f->x[1] < 0) {
        f->x[0] = DBL_MIN;
        f->x[1] *= -f->e;
        f->count++;
        if (f->x[1] < 1e-3) f->x[1] = f->g = 0;
        *values = true;
    }
    if (f->kind == STAIR) {
        if (f->time >= f->count + 1) f->count++;
        *announces = true;
        *when = f->count + 1;
        *again = f->time >= *when;
    }
    return OK;
}

int fmi3EnterContinuousTimeMode(Foreign *f) {
    if (f->mode != EVENTS) return ERROR;
    f->mode = CONTINUOUS;
    return OK;
}

int fmi3CompletedIntegratorStep(Foreign *f, bool no_way_back, bool *enter, bool *terminate) {
    *enter = *terminate = false;
    return f->mode == CONTINUOUS ? OK : ERROR;
}

int fmi3SetTime(Foreign *f, double time) {
    f->time = time;
    return OK;
}

static size_t states(const Foreign *f) { return f->kind == STAIR ? 0 : 2; }

int fmi3GetNumberOfContinuousStates(Foreign *f, size_t *count) {
    *count = states(f);
    return OK;
}

int fmi3GetNumberOfEventIndicators(Foreign *f, size_t *count) {
    *count = f->kind == BOUNCING;
    return OK;
}

int fmi3SetContinuousStates(Foreign *f, const double x[], size_t count) {
    if (f->mode != CONTINUOUS || count != states(f)) return ERROR;
    memcpy(f->x, x, count * sizeof *x);
    return OK;
}

int fmi3GetContinuousStates(Foreign *f, double x[], size_t count) {
    if (count != states(f)) return ERROR;
    memcpy(x, f->x, count * sizeof *x);
    return OK;
}

int fmi3GetNominalsOfContinuousStates(Foreign *f, double x[], size_t count) {
    for (size_t k = 0; k < count; k++) x[k] = 1;
    return count == states(f) ? OK : ERROR;
}

static double rate(const Foreign *f, size_t k) {
    if (k == 0) return f->x[1];
    return f->kind == BOUNCING ? f->g : (1 - f->x[0] * f->x[0]) * f->x[1] - f->x[0];
}

int fmi3GetContinuousStateDerivatives(Foreign *f, double rates[], size_t count) {
    if (count != states(f)) return ERROR;
    if (fabs(f->x[0]) > 1e3) return DISCARD;
    for (size_t k = 0; k < count; k++) rates[k] = rate(f, k);
    return OK;
}

int fmi3GetEventIndicators(Foreign *f, double z[], size_t count) {
    if (count != (f->kind == BOUNCING)) return ERROR;
    if (count) z[0] = f->g == 0 ? 1 : f->x[0];
    return OK;
}

int fmi3GetFloat64(Foreign *f, const uint32_t vr[], size_t count, double values[], size_t value_count) {
    for (size_t k = 0; k < count; k++)
        values[k] = vr[k] == 0 ? f->time : vr[k] <= 2 ? f->x[vr[k] - 1] : vr[k] <= 4 ? rate(f, vr[k] - 3)
                    : vr[k] == 5 ? f->e : f->x[0];
    return OK;
}

int fmi3SetFloat64(Foreign *f, const uint32_t vr[], size_t count, const double values[], size_t value_count) {
    for (size_t k = 0; k < count; k++) {
        if (vr[k] != 5) return ERROR;
        f->e = values[k];
    }
    return OK;
}

int fmi3GetInt32(Foreign *f, const uint32_t vr[], size_t count, int32_t values[], size_t value_count) {
    for (size_t k = 0; k < count; k++) values[k] = f->count;
    return OK;
}

int fmi3GetFMUState(Foreign *f, void **state) {
    if (!*state) *state = malloc(sizeof *f);
    memcpy(*state, f, sizeof *f);
    return OK;
}

int fmi3SetFMUState(Foreign *f, void *state) {
    memcpy(f, state, sizeof *f);
    return OK;
}

int fmi3FreeFMUState(Foreign *f, void **state) {
    free(*state);
    *state = NULL;
    return OK;
}

int fmi3Terminate(Foreign *f) { return OK; }
