/* Times the native FMU and the bare engine in turns, in one process without Python.
   Usage: host FMU-LIBRARY GUID ENGINE-LIBRARY BLOCK WORDS TORQUE-WORD TORQUE-REFERENCE SPEED-WORD SPEED-REFERENCE ROUNDS
   BLOCK is a file with an instance's block before the motion begins; TORQUE-WORD is where it holds the drive torque,
   SPEED-WORD where an output.
   Prints one line a round: nanoseconds a step of engine and FMU with constant input, of engine and FMU with a new input
   each step, of instantiate .. exitInitializationMode, of a saved and restored state; then that output at the end, of
   engine and FMU with constant input, of both with a new input each step. */
#define _POSIX_C_SOURCE 199309L
#include <dlfcn.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2Functions.h"

#define STEP 1e-3
enum { STEPS = 2000, STARTS = 20, STATES = 2000, STOP_AT_TARGET = 0 };

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1e9 + t.tv_nsec;
}

static void *find(void *library, const char *name) {
    void *found = dlsym(library, name);
    if (!found) {
        fprintf(stderr, "%s\n", dlerror());
        exit(3);
    }
    return found;
}

static void *open_library(const char *path) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        exit(3);
    }
    return library;
}

static void check(int status, const char *call) {
    if (status) {
        fprintf(stderr, "%s: status %d\n", call, status);
        exit(4);
    }
}

static void logger(void *environment, const char *name, fmi2Status status, const char *category, const char *text, ...) {
    (void)environment, (void)name, (void)status, (void)category;
    fprintf(stderr, "%s\n", text);
}

static const fmi2CallbackFunctions CALLBACKS = {logger, calloc, free, NULL, NULL};
static double torque_of(int k, int changes) { return changes && k % 2 ? 1.1e-3 : 1e-3; }

int main(int argc, char **argv) {
    if (argc != 11) return 2;
    void *fmu = open_library(argv[1]), *engine = open_library(argv[3]);
    fmi2InstantiateTYPE *instantiate = find(fmu, "fmi2Instantiate");
    fmi2FreeInstanceTYPE *free_instance = find(fmu, "fmi2FreeInstance");
    fmi2SetupExperimentTYPE *set_up = find(fmu, "fmi2SetupExperiment");
    fmi2EnterInitializationModeTYPE *enter = find(fmu, "fmi2EnterInitializationMode");
    fmi2ExitInitializationModeTYPE *leave = find(fmu, "fmi2ExitInitializationMode");
    fmi2DoStepTYPE *do_step = find(fmu, "fmi2DoStep");
    fmi2SetRealTYPE *set = find(fmu, "fmi2SetReal");
    fmi2GetFMUstateTYPE *get_state = find(fmu, "fmi2GetFMUstate");
    fmi2SetFMUstateTYPE *set_state = find(fmu, "fmi2SetFMUstate");
    fmi2FreeFMUstateTYPE *free_state = find(fmu, "fmi2FreeFMUstate");
    int64_t (*begin)(double *, int64_t, double) = find(engine, "engine_begin");
    fmi2GetRealTYPE *get = find(fmu, "fmi2GetReal");
    void (*read_outputs)(double *, int64_t) = find(engine, "engine_read_outputs");
    int64_t (*advance)(double *, int64_t, double) = find(engine, "engine_advance");

    int64_t words = atoll(argv[5]);
    size_t torque = (size_t)atoll(argv[6]);
    fmi2ValueReference reference = (fmi2ValueReference)atoi(argv[7]);
    size_t speed = (size_t)atoll(argv[8]);
    fmi2ValueReference speed_reference = (fmi2ValueReference)atoi(argv[9]);
    double *template = malloc((size_t)words * 8), *block = malloc((size_t)words * 8);
    FILE *file = fopen(argv[4], "rb");
    if (!file || fread(template, 8, (size_t)words, file) != (size_t)words) return 5;
    fclose(file);

    for (int round = 0; round < atoi(argv[10]); round++) {
        double spent[2][2], end[2][2];
        for (int changes = 0; changes < 2; changes++) {
            memcpy(block, template, (size_t)words * 8);
            check((int)begin(block, words, 0.0), "begin");
            check((int)advance(block, words, 0.0), "advance");
            double start = now();
            for (int k = 0; k < STEPS; k++) {
                block[torque] = torque_of(k, changes);
                check((int)advance(block, words, k * STEP + STEP), "advance");
            }
            spent[changes][0] = (now() - start) / STEPS;
            read_outputs(block, words);
            end[changes][0] = block[speed];

            fmi2Component c = instantiate("one", fmi2CoSimulation, argv[2], "", &CALLBACKS, 0, 0);
            if (!c) return 6;
            check(set_up(c, 0, 0, 0, 0, 0), "setup");
            check(enter(c), "enter");
            check(leave(c), "leave");
            start = now();
            for (int k = 0; k < STEPS; k++) {
                if (changes) {
                    double value = torque_of(k, 1);
                    check(set(c, &reference, 1, &value), "set");
                }
                check(do_step(c, k * STEP, STEP, 1), "step");
            }
            spent[changes][1] = (now() - start) / STEPS;
            check(get(c, &speed_reference, 1, &end[changes][1]), "get");
            free_instance(c);
        }
        double start = now();
        fmi2Component c = NULL;
        for (int k = 0; k < STARTS; k++) {
            if (c) free_instance(c);
            c = instantiate("one", fmi2CoSimulation, argv[2], "", &CALLBACKS, 0, 0);
            check(set_up(c, 0, 0, 0, 0, 0), "setup");
            check(enter(c), "enter");
            check(leave(c), "leave");
        }
        double a_start = (now() - start) / STARTS;
        fmi2FMUstate state = NULL;
        start = now();
        for (int k = 0; k < STATES; k++) {
            check(get_state(c, &state), "get state");
            check(set_state(c, state), "set state");
        }
        double a_state = (now() - start) / STATES;
        free_state(c, &state);
        free_instance(c);
        printf("%.17g %.17g %.17g %.17g %.17g %.17g ", spent[0][0], spent[0][1], spent[1][0], spent[1][1], a_start, a_state);
        printf("%.17g %.17g %.17g %.17g\n", end[0][0], end[0][1], end[1][0], end[1][1]);
    }
    return 0;
}
