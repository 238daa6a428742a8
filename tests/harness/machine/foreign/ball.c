/* A foreign FMU of FMI 3.0: a ball that falls on a floor and bounces, in closed form, with event mode and early return.
 *
 * Functions that it has no use for are added by build.py, which refuse. Value references: 0 height, 1 speed, 2 restitution,
 * 3 bounces, 4 kicks (a discrete input: each changes the speed by 1 m/s). */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { OK = 0, ERROR = 3 };
static const double G = 9.81;

typedef struct {
    double time, height, speed, restitution;
    int32_t bounces, kicks;
    bool event_mode, early, in_event_mode, struck, settling;
} Ball;

const char *fmi3GetVersion(void) { return "3.0"; }

int fmi3Reset(Ball *b) {
    bool event_mode = b->event_mode, early = b->early;
    *b = (Ball){.height = 1.0, .restitution = 0.5, .event_mode = event_mode, .early = early};
    return OK;
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                  bool event_mode, bool early, const uint32_t *required, size_t count, void *environment,
                                  void *log, void *update) {
    Ball *b = calloc(1, sizeof *b);
    b->event_mode = event_mode;
    b->early = early;
    fmi3Reset(b);
    return b;
}

void fmi3FreeInstance(Ball *b) { free(b); }

int fmi3EnterInitializationMode(Ball *b, bool tolerance_defined, double tolerance, double start, bool stop_defined,
                                double stop) {
    b->time = start;
    return OK;
}

int fmi3ExitInitializationMode(Ball *b) {
    b->in_event_mode = b->event_mode;
    return OK;
}

int fmi3EnterEventMode(Ball *b) {
    if (!b->event_mode || b->in_event_mode) return ERROR;
    b->in_event_mode = true;
    return OK;
}

static void bounce(Ball *b) {
    b->speed *= -b->restitution;
    b->bounces++;
    b->struck = false;
}

/* A bounce takes two updates, so that an importer must repeat them. */
int fmi3UpdateDiscreteStates(Ball *b, bool *again, bool *ends, bool *nominals, bool *values, bool *next, double *when) {
    if (!b->in_event_mode) return ERROR;
    *again = *ends = *nominals = *values = *next = false;
    if (b->struck && !b->settling) {
        *again = b->settling = true;
    } else if (b->struck) {
        bounce(b);
        b->settling = false;
    }
    return OK;
}

int fmi3EnterStepMode(Ball *b) {
    if (!b->in_event_mode || b->struck) return ERROR;
    b->in_event_mode = false;
    return OK;
}

int fmi3Terminate(Ball *b) { return OK; }

int fmi3DoStep(Ball *b, double now, double size, bool no_way_back, bool *event, bool *ends, bool *early, double *reached) {
    *event = *ends = *early = false;
    if (b->in_event_mode || fabs(now - b->time) > 1e-12) return ERROR;
    double end = now + size;
    while (b->time < end) {
        double fall = (b->speed + sqrt(b->speed * b->speed + 2 * G * b->height)) / G;
        bool strikes = fall > 0 && b->time + fall <= end;
        double span = strikes ? fall : end - b->time;
        b->height = strikes ? 0.0 : b->height + b->speed * span - G * span * span / 2;
        b->speed -= G * span;
        b->time = strikes ? b->time + fall : end;
        if (!strikes) break;
        b->struck = true;
        if (b->event_mode && b->early) {
            *event = true;
            *early = b->time < end;
            break;
        }
        bounce(b);
    }
    *reached = b->time;
    return OK;
}

int fmi3GetFloat64(Ball *b, const uint32_t *vr, size_t n, double *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (vr[k] > 2) return ERROR;
        values[k] = (&b->height)[vr[k]];
    }
    return OK;
}

int fmi3SetFloat64(Ball *b, const uint32_t *vr, size_t n, const double *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (vr[k] != 2) return ERROR;
        b->restitution = values[k];
    }
    return OK;
}

int fmi3GetInt32(Ball *b, const uint32_t *vr, size_t n, int32_t *values, size_t count) {
    for (size_t k = 0; k < n; k++) values[k] = vr[k] == 3 ? b->bounces : b->kicks;
    return OK;
}

int fmi3SetInt32(Ball *b, const uint32_t *vr, size_t n, const int32_t *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (vr[k] != 4 || (b->event_mode && b->time > 0 && !b->in_event_mode)) return ERROR;
        b->speed += values[k] - b->kicks;
        b->kicks = values[k];
    }
    return OK;
}

int fmi3GetFMUState(Ball *b, void **state) {
    if (!*state) *state = malloc(sizeof *b);
    memcpy(*state, b, sizeof *b);
    return OK;
}

int fmi3SetFMUState(Ball *b, void *state) {
    memcpy(b, state, sizeof *b);
    return OK;
}

int fmi3FreeFMUState(Ball *b, void **state) {
    free(*state);
    *state = NULL;
    return OK;
}
