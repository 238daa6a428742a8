/* What a page needs beyond FMI 3.0, in a module that imports nothing: messages as text, and a whole run in one call. */
#include <string.h>

#include "fmi3Functions.h"

#define OF_PAGE(name) __attribute__((export_name(#name)))

enum { REFUSED = -1, ON_GRID, AT_IMPACT };
enum { MOST_OF_A_KIND = 256 };

static char text[8192];

static void keep_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                         fmi3String message) {
    (void)environment;
    (void)category;
    size_t used = strlen(text), more = strlen(message);
    if (status == fmi3OK || used + more + 2 > sizeof text) return;
    memcpy(text + used, message, more);
    text[used + more] = '\n';
    text[used + more + 1] = 0;
}

/* What has been said since the instance was made, a message a line: refusals and warnings. */
OF_PAGE(page_text) const char *page_text(void) { return text; }

OF_PAGE(page_make) void *page_make(const char *token) {
    text[0] = 0;
    return fmi3InstantiateCoSimulation("page", token, "", fmi3False, fmi3True, fmi3True, fmi3True, NULL, 0, NULL,
                                       keep_message, NULL);
}

static fmi3Status end_event_mode(void *c) {
    fmi3Boolean again, terminate, nominals, values, has_time;
    double time;
    fmi3Status status = fmi3UpdateDiscreteStates(c, &again, &terminate, &nominals, &values, &has_time, &time);
    return status == fmi3OK ? fmi3EnterStepMode(c) : status;
}

/* Ready to step, at `start`; a status. */
OF_PAGE(page_begin) int page_begin(void *c, double start) {
    fmi3Status status = fmi3EnterInitializationMode(c, fmi3False, 0, start, fmi3False, 0);
    if (status == fmi3OK) status = fmi3ExitInitializationMode(c);
    return status == fmi3OK ? (int)end_event_mode(c) : (int)status;
}

/* To `target`, or to an impact before it. */
static int step(void *c, double *now, double target) {
    fmi3Boolean event, terminate, early;
    if (fmi3DoStep(c, *now, target - *now, fmi3True, &event, &terminate, &early, now) != fmi3OK) return REFUSED;
    if (!event) return ON_GRID;
    if (fmi3EnterEventMode(c) != fmi3OK || end_event_mode(c) != fmi3OK) return REFUSED;
    return early ? AT_IMPACT : ON_GRID;
}

/* Value references of variables of a kind. */
typedef struct {
    const fmi3ValueReference *of;
    int count;
} List;

/* The values of reals, flags and whole numbers behind each other; a status. */
static fmi3Status record(void *c, List reals, List flags, List wholes, double *here) {
    fmi3Boolean seen[MOST_OF_A_KIND];
    fmi3Int32 counted[MOST_OF_A_KIND];
    fmi3Status status = fmi3GetFloat64(c, reals.of, (size_t)reals.count, here, (size_t)reals.count);
    if (status == fmi3OK && flags.count)
        status = fmi3GetBoolean(c, flags.of, (size_t)flags.count, seen, (size_t)flags.count);
    if (status == fmi3OK && wholes.count)
        status = fmi3GetInt32(c, wholes.of, (size_t)wholes.count, counted, (size_t)wholes.count);
    if (status != fmi3OK) return status;
    for (int k = 0; k < flags.count; k++) here[reals.count + k] = seen[k];
    for (int k = 0; k < wholes.count; k++) here[reals.count + flags.count + k] = counted[k];
    return fmi3OK;
}

/* Rows (time, 1 behind an impact else 0, `reals`, `flags`, `wholes`): where it is, at each of the next `steps` points of a
   grid, and behind each impact between them. `*now` goes on to where the last row is; fewer points than asked for: it was
   refused, or `room` rows are full. Returns the number of rows. */
OF_PAGE(page_run)
int page_run(void *c, double *now, double spacing, int steps, int room, const fmi3ValueReference *reals, int real_count,
             const fmi3ValueReference *flags, int flag_count, const fmi3ValueReference *wholes, int whole_count,
             double *rows) {
    if (flag_count > MOST_OF_A_KIND || whole_count > MOST_OF_A_KIND) {
        keep_message(NULL, fmi3Error, "",
                     "page_run: a page records at most 256 Boolean and 256 Integer outputs; declare fewer.");
        return 0;
    }
    double start = *now;
    int row = 0, what = ON_GRID;
    for (int point = 0; row < room;) {
        double *here = rows + (size_t)row * (size_t)(2 + real_count + flag_count + whole_count);
        here[0] = *now;
        here[1] = what == AT_IMPACT;
        if (record(c, (List){reals, real_count}, (List){flags, flag_count}, (List){wholes, whole_count}, here + 2) != fmi3OK)
            break;
        row++;
        if (point >= steps) break;
        what = step(c, now, start + (point + 1) * spacing);
        if (what == REFUSED) break;
        if (what == ON_GRID) point++;
    }
    return row;
}
