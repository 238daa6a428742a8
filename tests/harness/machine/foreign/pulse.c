/* A foreign FMU of FMI 3.0 with clocks: it strikes each `period`, and at each tick of its input clock.
 *
 * 1 period (Float64, parameter), 2 tick (output clock: at a strike), 3 number (Int32, which strike; there with tick only),
 * 4 strikes (Int32, output: so many have been counted), 5 poke (input clock: strikes at once), 6 weight (Int32, input,
 * there with poke only), 7 sum (Float64, output: weights so far), 8 echo (output clock: at each poke), 9 echoed (Int32: the
 * weight that has just come; there with echo only), 10 seen (Int32, discrete input), 11 seen_now (Int32, output: seen),
 * 12 alarm (Float64, parameter; 0: none), 13 alarms (Int32, output): each `alarm` it announces an event, and refuses a step
 * that goes beyond it.
 *
 * It refuses to work without event mode, to tell what ticks when nothing does, and to take two pokes at one update. Each
 * strike takes two updates. Functions that it has no use for are added by build.py. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { OK = 0, ERROR = 3 };

typedef struct {
    double period, sum, alarm, time, next, alarm_at;
    int32_t strikes, weight, seen, seen_now, alarms;
    bool early, in_event_mode, initialized, struck, told, poked, echo_told, settling;
} Pulse;

const char *fmi3GetVersion(void) { return "3.0"; }

int fmi3Reset(Pulse *p) {
    bool early = p->early;
    *p = (Pulse){.period = 0.25, .early = early};
    return OK;
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                  bool event_mode, bool early, const uint32_t *required, size_t count, void *environment,
                                  void *log, void *update) {
    if (!event_mode) return NULL;
    Pulse *p = calloc(1, sizeof *p);
    p->early = early;
    fmi3Reset(p);
    return p;
}

void fmi3FreeInstance(Pulse *p) { free(p); }

int fmi3EnterInitializationMode(Pulse *p, bool tolerance_defined, double tolerance, double start, bool stop_defined,
                                double stop) {
    p->time = start;
    return OK;
}

int fmi3ExitInitializationMode(Pulse *p) {
    if (p->initialized) return ERROR;
    p->next = p->time + p->period;
    p->alarm_at = p->time + p->alarm;
    p->initialized = p->in_event_mode = true;
    return OK;
}

int fmi3EnterEventMode(Pulse *p) {
    if (p->in_event_mode) return ERROR;
    p->in_event_mode = true;
    return OK;
}

int fmi3UpdateDiscreteStates(Pulse *p, bool *again, bool *ends, bool *nominals, bool *values, bool *next, double *when) {
    if (!p->in_event_mode) return ERROR;
    *again = *ends = *nominals = *values = *next = false;
    if (p->poked) p->sum += p->weight;
    p->poked = p->echo_told = false;
    p->seen_now = p->seen;
    if (p->alarm > 0 && p->time >= p->alarm_at - 1e-9) {
        p->alarms++;
        p->alarm_at += p->alarm;
    }
    *next = p->alarm > 0;
    *when = p->alarm_at;
    if (p->struck && !p->settling) {
        *again = p->settling = true;
    } else if (p->struck) {
        p->struck = p->settling = p->told = false;
        p->strikes++;
    }
    return OK;
}

int fmi3EnterStepMode(Pulse *p) {
    if (!p->in_event_mode || p->struck || p->poked) return ERROR;
    p->in_event_mode = false;
    return OK;
}

int fmi3Terminate(Pulse *p) { return OK; }

int fmi3DoStep(Pulse *p, double now, double size, bool no_way_back, bool *event, bool *ends, bool *early, double *reached) {
    *event = *ends = *early = false;
    if (p->in_event_mode || fabs(now - p->time) > 1e-9) return ERROR;
    double end = now + size;
    if (p->alarm > 0 && end > p->alarm_at + 1e-9) return ERROR;
    if (p->period > 0 && p->next <= end + 1e-9) {
        *event = p->struck = true;
        *early = p->early && p->next < end - 1e-9;
        p->time = *early ? p->next : end;
        p->next += p->period;
    } else {
        p->time = end;
    }
    *reached = p->time;
    return OK;
}

int fmi3GetClock(Pulse *p, const uint32_t *vr, size_t n, bool *values) {
    if (!p->in_event_mode) return ERROR;
    for (size_t k = 0; k < n; k++) {
        if (vr[k] == 2) {
            values[k] = p->struck && !p->told;
            p->told = p->told || p->struck;
        } else if (vr[k] == 8) {
            values[k] = p->poked && !p->echo_told;
            p->echo_told = p->poked;
        } else {
            return ERROR;
        }
    }
    return OK;
}

int fmi3SetClock(Pulse *p, const uint32_t *vr, size_t n, const bool *values) {
    for (size_t k = 0; k < n; k++) {
        if (!p->in_event_mode || vr[k] != 5 || p->poked) return ERROR;
        p->poked = values[k];
    }
    return OK;
}

int fmi3GetFloat64(Pulse *p, const uint32_t *vr, size_t n, double *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (vr[k] != 1 && vr[k] != 7 && vr[k] != 12) return ERROR;
        values[k] = vr[k] == 1 ? p->period : vr[k] == 7 ? p->sum : p->alarm;
    }
    return OK;
}

int fmi3SetFloat64(Pulse *p, const uint32_t *vr, size_t n, const double *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if ((vr[k] != 1 && vr[k] != 12) || p->initialized) return ERROR;
        *(vr[k] == 1 ? &p->period : &p->alarm) = values[k];
    }
    return OK;
}

int fmi3GetInt32(Pulse *p, const uint32_t *vr, size_t n, int32_t *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (vr[k] == 3 && !(p->in_event_mode && p->struck)) return ERROR;
        if (vr[k] == 9 && !(p->in_event_mode && p->poked)) return ERROR;
        switch (vr[k]) {
        case 3: values[k] = p->strikes + 1; break;
        case 4: values[k] = p->strikes; break;
        case 9: values[k] = p->weight; break;
        case 10: values[k] = p->seen; break;
        case 11: values[k] = p->seen_now; break;
        case 13: values[k] = p->alarms; break;
        default: return ERROR;
        }
    }
    return OK;
}

int fmi3SetInt32(Pulse *p, const uint32_t *vr, size_t n, const int32_t *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (p->initialized && !p->in_event_mode) return ERROR;
        if (vr[k] == 6 && p->poked) p->weight = values[k];
        else if (vr[k] == 10) p->seen = values[k];
        else return ERROR;
    }
    return OK;
}

int fmi3GetFMUState(Pulse *p, void **state) {
    if (!*state) *state = malloc(sizeof *p);
    memcpy(*state, p, sizeof *p);
    return OK;
}

int fmi3SetFMUState(Pulse *p, void *state) {
    memcpy(p, state, sizeof *p);
    return OK;
}

int fmi3FreeFMUState(Pulse *p, void **state) {
    free(*state);
    *state = NULL;
    return OK;
}
