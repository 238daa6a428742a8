/* A host in C that is not Python: what it needs of a version of FMI (fmi2.c or fmi3.c) and of the system (host.c). */
#ifndef HOST_H
#define HOST_H

#include <stddef.h>

/* A function of the FMU's library by its name; without it the host ends. */
void *function(const char *name);

/* Hand on what the FMU has logged. */
void told(const char *category, const char *format, ...);

/* Calls of a version of FMI; each returns its status. `kind` is r, i or b: Real, Integer or Boolean. */
void bind_functions(void);
void *make(const char *name, const char *token, const char *resources);
void release(void *x);
int begin(void *x);
int step(void *x, double *time, double size); /* to the end of the step, whatever happens; moves `time` */
int set_value(void *x, char kind, unsigned reference, double value);
int get_value(void *x, char kind, unsigned reference, double *value);
int reset(void *x);
int terminate(void *x);
int save(void *x, void **state);
int restore(void *x, void *state);
int forget(void *x, void **state);
int size_of(void *x, void *state, size_t *size);
int to_bytes(void *x, void *state, char *bytes, size_t size);
int from_bytes(void *x, const char *bytes, size_t size, void **state);

/* How many steps have been returned early, of all instances (FMI 3.0). */
extern int early_returns;

#endif
