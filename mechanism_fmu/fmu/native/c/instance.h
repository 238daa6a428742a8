/* An instance: what both versions of FMI do alike. Each function that can refuse says why in the log and returns ERROR. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "log.h"
#include "instance_data.h"

/* A value as the host passes it. */
typedef enum { AS_DOUBLE, AS_INT32, AS_BYTE } Form;

/* A saved state. */
typedef struct Saved Saved;

Instance *make_instance(const char *name, int fmi, void *(*allocate)(size_t, size_t), void (*release)(void *));
void free_instance(Instance *x);

Status set_up(Instance *x, const char *call, double start_time, int stop_defined, double stop_time, int tolerance_defined,
              double tolerance);
Status initialized(Instance *x);
void reset(Instance *x);
void write_tables(Instance *x); /* for the present parameters and tolerance, if they are not yet */
Status prepare(Instance *x);    /* assemble and begin; before the first step it is done anew after each change */
/* Whether a mechanism can have the parameters of a saved state. */
Status check_values_together(Instance *x, const Head *head, const double *parameters);
void forget_motion(const Instance *x, double *state); /* all of a state but its inputs, as before the first call */
Status require(Instance *x, const char *call, unsigned phases); /* a bit for each phase in which it is allowed */
#define IN(phase) (1u << (phase))

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

#endif
