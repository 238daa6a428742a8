/* Model Exchange: what an instance does for an importer that integrates by itself; each call may refuse as instance.h. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "instance.h"

/* What an importer learns of its events. */
typedef struct {
    int states_changed;
    double next_time; /* of an event by time [s]; infinite where there is none */
} EventNews;

Status enter_events(Instance *x, const char *call);
Status update_events(Instance *x, const char *call, EventNews *news);
Status enter_continuous(Instance *x, const char *call);
Status complete_step(Instance *x, const char *call, int *wants_events);
Status set_instant(Instance *x, const char *call, double time);
Status set_states(Instance *x, const char *call, const double states[], size_t count);
/* States, their derivatives or nominals, and event indicators; where nothing finite comes of states, DISCARD. */
Status get_states(Instance *x, const char *call, double states[], size_t count);
Status get_derivatives(Instance *x, const char *call, double derivatives[], size_t count);
Status get_nominals(Instance *x, const char *call, double nominals[], size_t count);
Status get_indicators(Instance *x, const char *call, double indicators[], size_t count);

/* Directional derivatives of outputs, and of derivatives of states, by inputs, and in Model Exchange by states. */
Status directional(Instance *x, const char *call, const unsigned unknown[], size_t unknowns, const unsigned known[],
                   size_t knowns, const double seed[], double value[]);
Status adjoint(Instance *x, const char *call, const unsigned unknown[], size_t unknowns, const unsigned known[],
               size_t knowns, const double seed[], double value[]);

/* Variables of their own, behind all others: states, their derivatives, and in FMI 3.0 the event indicators. */
int is_exchanged(const Instance *x, unsigned vr);
unsigned last_exchanged(const Instance *x);
double exchanged(Instance *x, unsigned vr);

#endif
