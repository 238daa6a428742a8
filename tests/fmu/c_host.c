/* A host that is not Python: loads an unzipped FMU, makes instances one after the other, steps the last, leaves.
   Usage: c_host FOLDER LIBRARY INSTANCES WHEN-TO-UNLOAD(never|end) */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void *Instance;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void *step_finished, *environment;
} Callbacks;

static void logger(void *environment, const char *name, int status, const char *category, const char *message, ...) {
    fprintf(stderr, "%s: %s\n", name, message);
}

static void *library;

static void *function(const char *name) {
    void *found = dlsym(library, name);
    if (!found) { fprintf(stderr, "no %s\n", name); exit(3); }
    return found;
}

static void check(int status, const char *call) {
    if (status) { fprintf(stderr, "%s: status %d\n", call, status); exit(4); }
}

int main(int argc, char **argv) {
    char resources[4096];
    Callbacks callbacks = {logger, calloc, free, NULL, NULL};
    Instance instance = NULL;
    double angle;
    unsigned int reference = (unsigned int)atoi(argv[5]);

    snprintf(resources, sizeof resources, "file://%s/resources", argv[1]);
    library = dlopen(argv[2], RTLD_NOW | RTLD_LOCAL);
    if (!library) { fprintf(stderr, "%s\n", dlerror()); return 3; }
    Instance (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) =
        function("fmi2Instantiate");
    void (*free_instance)(Instance) = function("fmi2FreeInstance");
    int (*setup)(Instance, int, double, double, int, double) = function("fmi2SetupExperiment");
    int (*enter)(Instance) = function("fmi2EnterInitializationMode");
    int (*leave)(Instance) = function("fmi2ExitInitializationMode");
    int (*step)(Instance, double, double, int) = function("fmi2DoStep");
    int (*get)(Instance, const unsigned int *, size_t, double *) = function("fmi2GetReal");

    for (int i = 0; i < atoi(argv[3]); i++) {
        if (instance) free_instance(instance);
        instance = instantiate("one", 1, "", resources, &callbacks, 0, 1);
        if (!instance) { fprintf(stderr, "no instance\n"); return 5; }
    }
    check(setup(instance, 0, 0, 0, 0, 0), "setup");
    check(enter(instance), "enter");
    check(leave(instance), "leave");
    for (int i = 0; i < 10; i++) check(step(instance, i * 1e-3, 1e-3, 1), "step");
    check(get(instance, &reference, 1, &angle), "get");
    free_instance(instance);
    printf("%.12g\n", angle);
    fflush(stdout);
    if (!strcmp(argv[4], "end")) dlclose(library);
    return 0;
}
