/* What an instance consists of, and how its fields are read; nothing here refuses or logs. */
#ifndef INSTANCE_DATA_H
#define INSTANCE_DATA_H

#include <stdint.h>

#include "engine.h"
#include "model.h"

/* The status of a call; the numbers are those of fmi2Status and fmi3Status. */
typedef enum { OK, WARNING, DISCARD, ERROR, FATAL } Status;

/* States of the life cycle. */
typedef enum { INSTANTIATED, INITIALIZATION, STEPPING, TERMINATED, EVENT, INTERMEDIATE, CONTINUOUS } Phase;

typedef struct Instance Instance;

/* How a message reaches the host. */
typedef void Log(const Instance *x, Status status, const char *category, const char *text);

/* What a saved state holds beside parameters and the engine's state. */
typedef struct {
    int64_t phase, set_up, prepared;
    double start_time, stop_time, tolerance;
    int64_t clock; /* FMI 3.0: there was an impact: the clock ticks in the event mode that is on, or may come next */
    int64_t left;  /* FMI 3.0: outputs are those before the impact, `left_outputs`, until the discrete states are updated */
    int64_t exchange; /* Model Exchange, not co-simulation */
    int64_t updated;  /* Model Exchange: the discrete states have been updated in this event mode */
} Head;

struct Instance {
    /* the host */
    char *name;
    Log *log;
    void *logger, *environment;
    void *(*allocate)(size_t count, size_t size);
    void (*release)(void *);
    unsigned categories; /* a bit for each that is logged */
    int fmi;             /* major version */
    int event_mode, early_return, exchange;
    void *intermediate_update;
    /* the model */
    Head head;
    double *parameters;                  /* as set */
    double *written, written_tolerance; /* what the tables were written for; the tolerance is NaN before */
    double *findings;
    double *states_before; /* an event of Model Exchange */
    double *block;
    int outputs_read;
    int64_t logged_impacts, logged_events, logged_lost, logged_passed;
    unsigned char *logged_pull;
};

/* No frame may be larger than a page of the stack (4 kB): Windows would need a run-time library to grow the stack. */
#define OWN_FRAME __attribute__((noinline))

/* FMI 3.0: the value references behind those of the scalars: time, the clock, and what there is with the clock only. */
#define TIME_REFERENCE (model.variable_count + 1)
#define CLOCK_REFERENCE (model.variable_count + 2)
#define FIRST_AGAIN (model.variable_count + 3)

/* Where a field of the block begins. */
#define FIELD(x, name) ((x)->block + ((const int64_t *)(x)->block)[SLOT_##name])
#define COUNTERS(x) ((int64_t *)FIELD(x, counters))
#define SIZE(x, name) ((size_t)((const int64_t *)(x)->block)[SIZE_##name])

/* The time reached [s]. */
static inline double time_of(const Instance *x) {
    return x->head.prepared ? FIELD(x, clock)[CODE_TIME] : x->head.start_time;
}

#endif
