/* A host that is not Python: loads an FMU's library and does what a script says, line by line.

   Usage: host LIBRARY RESOURCES TOKEN SCRIPT, with the folder of resources as FMI wants it.

       make K [TOKEN]              go on with instance K (0 to 9), made if need be
       free                        the instance
       set KIND REFERENCE VALUE    KIND: r, i or b
       get KIND REFERENCE          prints the value on a line of its own
       begin                       set up, initialize
       step SIZE [COUNT]
       save S, restore S, forget S a saved state (0 to 9) and its time
       copy S                      replaces a saved state by what comes out of its bytes
       cut S, spoil S              takes bytes of a state that are cut off, or of which one is flipped
       reset, terminate
       early                       prints how many steps were returned early
       unload                      the library
       refused LINE                what follows must be refused with an error

   Everything else must succeed. What the FMU logs goes to the standard error. The exit code is 0, or 4 for a call that
   did not do what it should. Everything is on static memory: Windows would need a run-time library for large frames. */
#include "host.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
__declspec(dllimport) void *__stdcall LoadLibraryA(const char *path);
__declspec(dllimport) void *__stdcall GetProcAddress(void *library, const char *name);
__declspec(dllimport) int __stdcall FreeLibrary(void *library);
#define load LoadLibraryA
#define find GetProcAddress
#define unload FreeLibrary
#else
#include <dlfcn.h>
#define load(path) dlopen(path, RTLD_NOW | RTLD_LOCAL)
#define find dlsym
#define unload dlclose
#endif

enum { FAILED = 3, UNKNOWN = -1, COUNT = 10, LINE = 1000 };

static void *library, *instances[COUNT], *states[COUNT], *x;
static double times[COUNT], saved_times[COUNT], *now = times;
static const char *resources, *token;

static void complain(const char *what, const char *name, int code) {
    fputs(what, stderr);
    fputs(name, stderr);
    fputs("\n", stderr);
    exit(code);
}

void *function(const char *name) {
    void *found = find(library, name);
    if (!found) complain("There is no function ", name, 3);
    return found;
}

void told(const char *category, const char *format, ...) {
    static char text[4000];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fputs(category, stderr);
    fputs(" ", stderr);
    fputs(text, stderr);
    fputs("\n", stderr);
}

static void print(double value) {
    char text[40];
    snprintf(text, sizeof text, "%.17g\n", value);
    fputs(text, stdout);
}

static const char *word(void) {
    const char *found = strtok(NULL, " \r\n");
    return found ? found : "";
}

static int make_current(int k) {
    const char *other = word();
    char name[] = "instance 0";
    name[9] = (char)('0' + k);
    if (!instances[k]) instances[k] = make(name, *other ? other : token, resources);
    if (!instances[k]) return FAILED;
    x = instances[k];
    now = times + k;
    return 0;
}

static void free_current(void) {
    release(x);
    instances[now - times] = x = NULL;
    *now = 0;
}

static int steps(void) {
    double size = strtod(word(), NULL);
    int count = atoi(word()), status = 0;
    for (int k = 0; k < (count ? count : 1) && status < FAILED; k++) status = step(x, now, size);
    return status;
}

static int set_one(void) {
    char kind = *word();
    unsigned reference = (unsigned)strtoul(word(), NULL, 10);
    return set_value(x, kind, reference, strtod(word(), NULL));
}

static int get_one(void) {
    double value;
    char kind = *word();
    int status = get_value(x, kind, (unsigned)strtoul(word(), NULL, 10), &value);
    if (status < FAILED) print(value);
    return status;
}

/* Put a saved state through its bytes, of which the last `cut` are missing and one is changed by `flip`. */
static int through_bytes(int s, size_t cut, char flip) {
    size_t size;
    void *copy = NULL;
    int status = size_of(x, states[s], &size);
    if (status >= FAILED) return status;
    char *bytes = malloc(size);
    if (!bytes) return FAILED;
    status = to_bytes(x, states[s], bytes, size);
    bytes[size / 2] ^= flip;
    if (status < FAILED) status = from_bytes(x, bytes, size - cut, &copy);
    free(bytes);
    if (status < FAILED) {
        forget(x, states + s);
        states[s] = copy;
    }
    return status;
}

static int with_state(const char *command) {
    int s = atoi(word()) % COUNT, status = UNKNOWN;
    if (!strcmp(command, "save")) {
        saved_times[s] = *now;
        return save(x, states + s);
    }
    if (!strcmp(command, "restore") && (status = restore(x, states[s])) < FAILED) *now = saved_times[s];
    if (!strcmp(command, "forget")) return forget(x, states + s);
    if (!strcmp(command, "copy")) return through_bytes(s, 0, 0);
    if (!strcmp(command, "cut")) return through_bytes(s, 1, 0);
    if (!strcmp(command, "spoil")) return through_bytes(s, 0, 1);
    return status;
}

/* The status of one call. */
static int call(const char *command) {
    if (!strcmp(command, "make")) return make_current(atoi(word()) % COUNT);
    if (!strcmp(command, "free")) return free_current(), 0;
    if (!strcmp(command, "set")) return set_one();
    if (!strcmp(command, "get")) return get_one();
    if (!strcmp(command, "begin")) return begin(x);
    if (!strcmp(command, "step")) return steps();
    if (!strcmp(command, "terminate")) return terminate(x);
    if (!strcmp(command, "early")) return print(early_returns), 0;
    if (!strcmp(command, "unload")) return unload(library), 0;
    if (!strcmp(command, "reset")) {
        *now = 0;
        return reset(x);
    }
    return with_state(command);
}

int main(int argc, char **argv) {
    static char line[LINE], copy[LINE];
    if (argc != 5) complain("Usage: host LIBRARY RESOURCES TOKEN SCRIPT", "", 2);
    library = load(argv[1]);
    if (!library) complain("Not to be loaded: ", argv[1], 3);
    resources = argv[2];
    token = argv[3];
    bind_functions();
    FILE *script = fopen(argv[4], "r");
    if (!script) complain("There is no ", argv[4], 2);
    while (fgets(line, LINE, script)) {
        strcpy(copy, line);
        const char *command = strtok(line, " \r\n");
        if (!command) continue;
        int refused = !strcmp(command, "refused");
        int status = call(refused ? word() : command);
        if (status == UNKNOWN) complain("Not a command: ", copy, 2);
        if (refused != (status >= FAILED)) complain(refused ? "Not refused: " : "Failed: ", copy, 4);
    }
    fclose(script);
    fflush(stdout);
    return 0;
}
