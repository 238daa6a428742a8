/* An FMU of FMI 2.0 that does to its host what it is told to, by the parameter `harm` (value reference 1) or
 * the environment variable HARM, in the step from 0.5 s on; its output y (0) is the time. Functions that it has no use for are added by build.py, which refuse. */
#define _GNU_SOURCE
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { OK, WARNING, DISCARD, ERROR };
enum { NOTHING, EXIT_0, QUICK_EXIT_0, END_0, ABORT, SEGFAULT, ABORT_IN_FREE, EXIT_IN_FREE, MOVE, NAN_OUT, INF_OUT, FLOOD,
       LONG_TEXT, HANG, EXIT_IN_INIT, LEAVE_FOREVER, ERROR_AFTER_FLOOD };

typedef void (*Logger)(void *, const char *, int, const char *, const char *, ...);
typedef struct { Logger logger; void *allocate, *release, *finished, *environment; } Callbacks;
typedef struct { int harm; double y; Callbacks callbacks; } Hostile;

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const Callbacks *callbacks,
                      int visible, int logging) {
    Hostile *h = calloc(1, sizeof *h);
    h->callbacks = *callbacks;
    if (getenv("HARM")) h->harm = atoi(getenv("HARM"));
    return h;
}

void fmi2FreeInstance(Hostile *h) {
    if (h->harm == ABORT_IN_FREE) abort();
    if (h->harm == EXIT_IN_FREE) exit(0);
    free(h);
}

int fmi2SetupExperiment(Hostile *h, int defined, double tolerance, double start, int stops, double stop) { return OK; }
int fmi2EnterInitializationMode(Hostile *h) { return OK; }
int fmi2ExitInitializationMode(Hostile *h) {
    if (h->harm == EXIT_IN_INIT) exit(0);
    return OK;
}
int fmi2Terminate(Hostile *h) { return OK; }
int fmi2Reset(Hostile *h) { h->y = 0.0; return OK; }

int fmi2GetReal(Hostile *h, const unsigned references[], size_t count, double values[]) {
    for (size_t k = 0; k < count; k++) values[k] = h->y;
    return OK;
}
int fmi2SetReal(Hostile *h, const unsigned references[], size_t count, const double values[]) { return OK; }
int fmi2GetInteger(Hostile *h, const unsigned references[], size_t count, int values[]) {
    for (size_t k = 0; k < count; k++) values[k] = h->harm;
    return OK;
}
int fmi2SetInteger(Hostile *h, const unsigned references[], size_t count, const int values[]) {
    h->harm = values[count - 1];
    return OK;
}

static void say(Hostile *h, int status, const char *text) { h->callbacks.logger(NULL, "hostile", status, "", text); }

static int flood(Hostile *h, const char *text) {
    for (int k = 0; k < 20000; k++) say(h, WARNING, text);
    return OK;
}

static int long_text(Hostile *h) {
    size_t size = 5000000;
    char *text = malloc(size + 1);
    memset(text, 'x', size);
    text[size] = 0;
    say(h, WARNING, text);
    free(text);
    return OK;
}

int fmi2DoStep(Hostile *h, double time, double size, int no_way_back) {
    h->y = time + size;
    if (time < 0.45) return OK;
    switch (h->harm) {
    case EXIT_0: exit(0);
    case QUICK_EXIT_0: quick_exit(0);
    case END_0: _exit(0);
    case ABORT: abort();
    case SEGFAULT: *(volatile int *)8 = 1; return OK;
    case MOVE: return chdir("/");
    case NAN_OUT: h->y = NAN; return OK;
    case INF_OUT: h->y = -INFINITY; return OK;
    case FLOOD: return flood(h, "the oil is hot");
    case LONG_TEXT: return long_text(h);
    case HANG: for (;;) sleep(1);
    case ERROR_AFTER_FLOOD: flood(h, "the oil is hot"); say(h, ERROR, "the shaft has broken"); return ERROR;
    default: return OK;
    }
}
