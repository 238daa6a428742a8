/* An instance: what both versions of FMI do alike. Each function that can refuse says why in the log and returns ERROR. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <stdint.h>

#include "engine.h"
#include "model.h"

/* The status of a call; the numbers are those of fmi2Status and fmi3Status. */
typedef enum { OK, WARNING, DISCARD, ERROR, FATAL } Status;

/* States of the life cycle. */
typedef enum { INSTANTIATED, INITIALIZATION, STEPPING, TERMINATED, EVENT, INTERMEDIATE } Phase;

typedef struct Instance Instance;

/* How a message reaches the host. */
typedef void Log(const Instance *x, Status status, const char *category, const char *text);

/* What a saved state holds beside parameters and the engine's state. */
typedef struct {
    int64_t phase, set_up, prepared;
    double start_time, stop_time, tolerance;
    int64_t clock; /* FMI 3.0: the clock `impact` ticks in the event mode that is on, or may be entered next */
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
    int event_mode, early_return;
    void *intermediate_update;
    /* the model */
    Head head;
    double *parameters;                  /* as set */
    double *written, written_tolerance; /* what the tables were written for; the tolerance is NaN before */
    double *findings;
    double *block;
    int outputs_read;
    int64_t told_impacts, told_events, told_lost;
    unsigned char *told_pull;
};

/* A value as the host passes it. */
typedef enum { AS_DOUBLE, AS_INT32, AS_BYTE } Form;

/* A saved state. */
typedef struct Saved Saved;

Instance *make_instance(const char *name, int fmi, void *(*allocate)(size_t, size_t), void (*release)(void *));
void free_instance(Instance *x);
Status set_logging(Instance *x, int on, size_t count, const char *const categories[]);

Status set_up(Instance *x, const char *call, double start_time, int stop_defined, double stop_time, int tolerance_defined,
              double tolerance);
Status initialized(Instance *x);
void reset(Instance *x);
void write_tables(Instance *x); /* for the present parameters and tolerance, if they are not yet */
Status prepare(Instance *x);    /* assemble and begin; before the first step it is done anew after each change */
Status require(Instance *x, const char *call, unsigned phases); /* a bit for each phase in which it is allowed */
#define IN(phase) (1u << (phase))

double time_of(const Instance *x);
Status step_target(Instance *x, const char *call, double current_time, double size, double *target);
Status begin_step(Instance *x, double target);
Status go_on(Instance *x, double target, int64_t rule);

Status get_values(Instance *x, int type, const unsigned vr[], size_t count, Form form, void *values, size_t value_count);
Status set_values(Instance *x, int type, const unsigned vr[], size_t count, Form form, const void *values,
                  size_t value_count);
Status set_slopes(Instance *x, const unsigned vr[], size_t count, const int order[], const double values[]);
Status get_rates(Instance *x, const unsigned vr[], size_t count, const int order[], double values[], size_t value_count);

Status save(Instance *x, Saved **state);
Status restore(Instance *x, const Saved *state);
void free_saved(Instance *x, Saved *state);
size_t serialized_size(void);
Status serialize(Instance *x, const Saved *state, unsigned char *bytes, size_t size);
Status deserialize(Instance *x, const unsigned char *bytes, size_t size, Saved **state);

void tell_news(Instance *x);
void forget_news(Instance *x);
/* No frame may be larger than a page of the stack (4 kB): Windows would need a run-time library to grow the stack. */
#define OWN_FRAME __attribute__((noinline))
OWN_FRAME void say(const Instance *x, Status status, const char *category, const char *format, ...);
OWN_FRAME Status refuse(const Instance *x, const char *format, ...);
const char *advice_details(Instance *x, int64_t outcome, char *text, size_t size);

/* The entry `index` of a field of the block. */
#define FIELD(x, name) ((x)->block + ((const int64_t *)(x)->block)[SLOT_##name])
#define COUNTERS(x) ((int64_t *)FIELD(x, counters))
#define SIZE(x, name) ((size_t)((const int64_t *)(x)->block)[SIZE_##name])

#endif
