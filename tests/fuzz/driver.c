/* Random calls of FMI 2.0 or 3.0 and forged saved states, against the C sources of one model's native FMU.
 *
 *     driver FMI SEED CALLS STATES [WORD BITS]...
 *
 * Prints how many calls and states there were, and ends with 0; anything else is a finding. The arrays of an instance
 * get allocations of their own, and its block pages of its own between pages that nobody may touch: the engine comes as
 * an object that no sanitizer has seen. With WORD and BITS, first this word of a saved state is forged, and no other. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "fmi2Functions.h"
#undef fmi2TypesPlatform
#include "fmi3Functions.h"
#include "instance.h"

enum { STEPS = 200, SLOTS = 4, MOST_VALUES = 6, ALL = 4000 };

static int may_exchange, with_exchange; /* Model Exchange */
static int fmi, with_event_mode, with_early_return, with_updates;
static uint64_t seed, calls, calls_with_forged, forged, accepted, done, by_status[8];
static int forging; /* calls now are about a forged state */
static Instance *x;
static char *pages;
static size_t page_bytes;
static void *slots[SLOTS];
static size_t most_steps; /* number of the parameter max_internal_steps */
static unsigned char *bytes;
static size_t size;

static uint64_t random64(void) {
    uint64_t z = (seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static uint64_t below(uint64_t n) { return random64() % n; }
static double uniform(void) { return (double)(random64() >> 11) * 0x1p-53; }

static void fail(const char *why) {
    fprintf(stderr, "FINDING: %s (after %llu calls and %llu forged states)\n", why, (unsigned long long)calls,
            (unsigned long long)forged);
    abort();
}

static int counted(int status) {
    if (forging) calls_with_forged++;
    else calls++;
    if (status < 0 || status > ERROR) fail("a status that this FMU never gives");
    by_status[status]++;
    return status;
}

/* --- the host --- */

static void tell2(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...) {
    (void)e, (void)name, (void)status, (void)category;
    char line[4000];
    va_list arguments;
    va_start(arguments, text);
    vsnprintf(line, sizeof line, text, arguments);
    va_end(arguments);
    if (getenv("FUZZ_LOG")) puts(line);
}

static void tell3(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String text) {
    (void)e, (void)status, (void)category;
    if (strlen(text) > 4000) fail("a message without end");
    if (getenv("FUZZ_LOG")) puts(text);
}

static void update3(fmi3InstanceEnvironment e, fmi3Float64 time, fmi3Boolean set, fmi3Boolean get, fmi3Boolean finished,
                    fmi3Boolean may_return, fmi3Boolean *early, fmi3Float64 *wanted) {
    (void)e, (void)set, (void)get, (void)finished, (void)may_return;
    if (below(8) == 0) counted(fmi3Reset(x)); /* refused */
    *early = below(6) == 0;
    *wanted = below(4) ? time + 1e-4 * uniform() : below(2) ? time - 1 : NAN;
}

/* --- an instance with arrays apart --- */

static void *apart(const void *array, size_t count) {
    char *copy = malloc(count ? count : 1);
    if (count) memcpy(copy, array, count);
    return copy;
}

static void part(void) {
    size_t of_block = model.words * sizeof(double), page = (size_t)sysconf(_SC_PAGESIZE);
    page_bytes = (of_block + page - 1) / page * page;
    pages = mmap(NULL, page_bytes + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED || mprotect(pages + page, page_bytes, PROT_READ | PROT_WRITE)) fail("no pages");
    double *block = (double *)(pages + page + (below(2) ? page_bytes - of_block : 0));
    memcpy(block, x->block, of_block);
    x->block = block;
    x->parameters = apart(x->parameters, model.parameters * sizeof(double));
    x->written = apart(x->written, model.parameters * sizeof(double));
    x->findings = apart(x->findings, (model.numbers + 2 * model.inputs) * sizeof(double));
    x->logged_pull = apart(x->logged_pull, SIZE(x, contacts));
}

static void begin(int well);

static void make(void) {
    static const fmi2CallbackFunctions host = {tell2, NULL, NULL, NULL, NULL};
    calls++;
    with_event_mode = model.has_clock || below(2), with_early_return = (int)below(2), with_updates = below(4) == 0;
    with_exchange = may_exchange && below(3) == 0;
    if (fmi == 2)
        x = fmi2Instantiate("fuzz", with_exchange ? fmi2ModelExchange : fmi2CoSimulation, model.guid, NULL, below(8) ? &host : NULL, 0, below(8) > 0);
    else if (with_exchange)
        x = fmi3InstantiateModelExchange("fuzz", model.guid, NULL, 0, below(8) > 0, NULL, below(8) ? tell3 : NULL);
    else
        x = fmi3InstantiateCoSimulation("fuzz", model.guid, NULL, 0, below(8) > 0, with_event_mode, with_early_return, NULL,
                                        0, NULL, below(8) ? tell3 : NULL, with_updates ? update3 : NULL);
    if (!x) fail("no instance");
    part();
    begin(below(8) > 0);
}

static void free_slot(int k) {
    if (fmi == 2) counted(fmi2FreeFMUstate(x, &slots[k]));
    else counted(fmi3FreeFMUState(x, &slots[k]));
}

static void unmake(void) {
    for (int k = 0; k < SLOTS; k++) free_slot(k);
    free(x->parameters), free(x->written), free(x->findings), free(x->logged_pull);
    calls++;
    if (fmi == 2) fmi2FreeInstance(x);
    else fmi3FreeInstance(x);
    munmap(pages, page_bytes + 2 * (size_t)sysconf(_SC_PAGESIZE));
}

/* Whatever happened, header and tables are still those of the model. */
static void check_tables(void) {
    size_t k = 0, force = (size_t)((const int64_t *)model.block)[SLOT_force_data];
    size_t behind = (size_t)((const int64_t *)model.block)[SLOT_force_data + 1];
    for (size_t word = 0; word < (size_t)((const int64_t *)model.block)[SLOT_FIRST_OF_STATE]; word++) {
        while (k < model.dependent_count && model.dependent[k].word < word) k++;
        if ((k < model.dependent_count && model.dependent[k].word == word) || (force <= word && word < behind)) continue;
        size_t settings = (size_t)((const int64_t *)model.block)[SLOT_settings];
        if (word == settings + CODE_RELATIVE_TOLERANCE) continue;
        if (memcmp(x->block + word, model.block + word, sizeof(double))) fail("a table was overwritten");
    }
}

/* --- calls --- */

static double any_number(void) {
    static const double odd[] = {0,    -0.0,    1,      -1,    NAN,    INFINITY, -INFINITY, 1e308,
                                 -1e308, 5e-324, 0x1p53, 0x1p63, -0x1p63, 1e-9,     1e9,       0.5};
    return below(2) ? odd[below(sizeof odd / sizeof *odd)] : (uniform() - 0.5) * pow(10, (double)below(30) - 15);
}

static unsigned reference(size_t place) { return (unsigned)place + 1; }

/* The variable of a value reference, or NULL. */
static const Variable *variable(unsigned vr) {
    return vr >= 1 && vr <= model.variable_count ? model.variables + (vr - 1) : NULL;
}

/* How many values it has in FMI 3.0. */
static size_t elements_of(unsigned vr) {
    size_t k = (size_t)vr - FIRST_AGAIN;
    return fmi == 3 && k < model.again_count ? (size_t)model.again[k].count : 1;
}

static unsigned any_reference(void) {
    return below(16) ? (unsigned)below(model.variable_count + 5 + model.again_count) : (unsigned)random64();
}

/* A value near the start of a variable, or within its limits. */
static double likely(const Variable *v) {
    if (v->type != REAL) return v->start + (double)below(3);
    return v->start * (0.8 + 0.4 * uniform()) + (below(3) ? 0 : 1e-3 * (uniform() - 0.5));
}

static double now(void) { return time_of(x); }

static int step(double at, double length) {
    fmi3Boolean event, terminate, early;
    double reached;
    if (fmi == 2) return counted(fmi2DoStep(x, at, length, 1));
    return counted(fmi3DoStep(x, at, length, 1, &event, &terminate, &early, &reached));
}

static void get(void) {
    unsigned vr[MOST_VALUES];
    double reals[ALL];
    int32_t whole[ALL];
    fmi3Boolean flags[ALL];
    size_t n = below(MOST_VALUES + 1), values = below(16) ? 0 : below(40);
    for (size_t k = 0; k < n; k++) {
        vr[k] = any_reference();
        values += elements_of(vr[k]);
    }
    switch (below(3)) {
        case 0: counted(fmi == 2 ? (int)fmi2GetReal(x, vr, n, reals) : (int)fmi3GetFloat64(x, vr, n, reals, values)); break;
        case 1: counted(fmi == 2 ? (int)fmi2GetInteger(x, vr, n, whole) : (int)fmi3GetInt32(x, vr, n, whole, values)); break;
        default: counted(fmi == 2 ? (int)fmi2GetBoolean(x, vr, n, whole) : (int)fmi3GetBoolean(x, vr, n, flags, values));
    }
}

static void get_all(void) {
    double value[ALL];
    for (size_t k = 0; k < model.variable_count; k++) {
        unsigned vr = reference(k);
        if (model.variables[k].type == REAL)
            counted(fmi == 2 ? (int)fmi2GetReal(x, &vr, 1, value) : (int)fmi3GetFloat64(x, &vr, 1, value, 1));
    }
    for (size_t k = 0; fmi == 3 && k < model.again_count; k++) {
        unsigned vr = (unsigned)(FIRST_AGAIN + k);
        if (model.variables[model.again[k].first].type == REAL)
            counted((int)fmi3GetFloat64(x, &vr, 1, value, (size_t)model.again[k].count));
    }
}

static void set(unsigned vr, double value) {
    int32_t whole = value >= -2e9 && value <= 2e9 ? (int32_t)value : (int32_t)below(9);
    fmi3Boolean flag = (fmi3Boolean)below(2);
    int type = variable(vr) && below(16) ? variable(vr)->type : (int)below(3);
    if (vr == reference(model.inputs + model.outputs + most_steps)) return;
    if (type == REAL) counted(fmi == 2 ? (int)fmi2SetReal(x, &vr, 1, &value) : (int)fmi3SetFloat64(x, &vr, 1, &value, 1));
    else if (type == INTEGER) counted(fmi == 2 ? (int)fmi2SetInteger(x, &vr, 1, &whole) : (int)fmi3SetInt32(x, &vr, 1, &whole, 1));
    else counted(fmi == 2 ? (int)fmi2SetBoolean(x, &vr, 1, &whole) : (int)fmi3SetBoolean(x, &vr, 1, &flag, 1));
}

static void set_some(void) {
    unsigned vr = below(3) ? reference(below(model.inputs + 1)) : any_reference();
    set(vr, variable(vr) && below(3) ? likely(variable(vr)) : any_number());
}

static void slopes(void) {
    unsigned vr = below(2) ? reference(below(model.inputs + 1)) : any_reference();
    int order = below(8) ? 1 : (int)below(4) - 1;
    double value = below(4) ? 1e-3 * (uniform() - 0.5) : any_number();
    if (fmi == 2 && below(2)) counted(fmi2SetRealInputDerivatives(x, &vr, 1, &order, &value));
    else if (fmi == 2) counted(fmi2GetRealOutputDerivatives(x, &vr, 1, &order, &value));
    else counted(fmi3GetOutputDerivatives(x, &vr, 1, &order, &value, 1));
}

/* What brings an instance on, or not when it is too early or too late. */
static void onward(int which, int well) {
    double start = well ? (below(2) ? 0 : uniform()) : any_number(), stop = well ? start + 1e6 : any_number();
    double tolerance = well ? 1e-6 : any_number();
    if (which == 0 && fmi == 2) counted(fmi2SetupExperiment(x, (int)below(2), tolerance, start, (int)below(2), stop));
    if (which == 1 && fmi == 2) counted(fmi2EnterInitializationMode(x));
    if (which == 1 && fmi == 3)
        counted(fmi3EnterInitializationMode(x, (int)below(2), tolerance, start, (int)below(2), stop));
    if (which == 2) counted(fmi == 2 ? (int)fmi2ExitInitializationMode(x) : (int)fmi3ExitInitializationMode(x));
    if (which == 3 && fmi == 3) counted(fmi3EnterStepMode(x));
    if (which == 4 && fmi == 3) counted(fmi3EnterEventMode(x));
}

static void begin(int well) {
    if (below(3) == 0)
        for (size_t k = below(3); k > 0; k--) {
            unsigned vr = reference(model.inputs + model.outputs + below(model.parameters));
            set(vr, below(4) ? likely(variable(vr)) : any_number());
        }
    unsigned budget = reference(model.inputs + model.outputs + most_steps);
    int32_t most = STEPS;
    counted(fmi == 2 ? (int)fmi2SetInteger(x, &budget, 1, &most) : (int)fmi3SetInt32(x, &budget, 1, &most, 1));
    for (int which = 0; well && which < 4; which++) onward(which, 1);
}

/* --- Model Exchange --- */

/* One of the calls that give or take numbers of all states or indicators; mostly with the right count. */
static void numbers(int which) {
    size_t states = SIZE(x, unknowns), count = which == 3 ? SIZE(x, indicators) : states;
    double *value = calloc(states + SIZE(x, indicators) + 1, sizeof *value);
    if (below(16) == 0) count += below(2) ? 1 : (size_t)-1;
    if (which == 4) {
        memcpy(value, FIELD(x, y_end), states * sizeof *value);
        for (size_t k = 0; k < states; k++) value[k] += 1e-3 * (uniform() - 0.5) * (below(3) == 0);
        if (below(8) == 0) value[below(states)] = any_number();
    }
    switch (which) {
        case 0: counted(fmi == 2 ? (int)fmi2GetContinuousStates(x, value, count) : (int)fmi3GetContinuousStates(x, value, count)); break;
        case 1: counted(fmi == 2 ? (int)fmi2GetDerivatives(x, value, count) : (int)fmi3GetContinuousStateDerivatives(x, value, count)); break;
        case 2: counted(fmi == 2 ? (int)fmi2GetNominalsOfContinuousStates(x, value, count) : (int)fmi3GetNominalsOfContinuousStates(x, value, count)); break;
        case 3: counted(fmi == 2 ? (int)fmi2GetEventIndicators(x, value, count) : (int)fmi3GetEventIndicators(x, value, count)); break;
        default: counted(fmi == 2 ? (int)fmi2SetContinuousStates(x, value, count) : (int)fmi3SetContinuousStates(x, value, count));
    }
    free(value);
}

static void events(void) {
    fmi2EventInfo info;
    fmi3Boolean flags[5];
    double when;
    counted(fmi == 2 ? (int)fmi2EnterEventMode(x) : (int)fmi3EnterEventMode(x));
    counted(fmi == 2 ? (int)fmi2NewDiscreteStates(x, &info)
                     : (int)fmi3UpdateDiscreteStates(x, flags, flags + 1, flags + 2, flags + 3, flags + 4, &when));
    if (below(8)) counted(fmi == 2 ? (int)fmi2EnterContinuousTimeMode(x) : (int)fmi3EnterContinuousTimeMode(x));
}

static void exchange(void) {
    int two, more;
    fmi3Boolean enter, end;
    double at = below(8) ? now() + 1e-3 * uniform() : any_number(), values[MOST_VALUES], seeds[MOST_VALUES];
    unsigned unknown[MOST_VALUES], known[MOST_VALUES];
    switch (below(8)) {
        case 0: events(); break;
        case 1: counted(fmi == 2 ? (int)fmi2SetTime(x, at) : (int)fmi3SetTime(x, at)); break;
        case 2: counted(fmi == 2 ? (int)fmi2CompletedIntegratorStep(x, 1, &two, &more)
                                 : (int)fmi3CompletedIntegratorStep(x, 1, &enter, &end)); break;
        case 3: {
            size_t n = below(MOST_VALUES + 1), m = below(MOST_VALUES + 1);
            for (size_t k = 0; k < MOST_VALUES; k++) {
                unknown[k] = below(4) ? reference(model.inputs + below(model.outputs)) : any_reference();
                known[k] = below(4) ? reference(below(model.inputs + 1)) : any_reference();
                seeds[k] = below(4) ? uniform() : any_number();
            }
            if (fmi == 2) counted(fmi2GetDirectionalDerivative(x, unknown, n, known, m, seeds, values));
            else if (below(2)) counted(fmi3GetDirectionalDerivative(x, unknown, n, known, m, seeds, m, values, n));
            else counted(fmi3GetAdjointDerivative(x, unknown, n, known, m, seeds, n, values, m));
            break;
        }
        default: numbers((int)below(5));
    }
}

static int take(void **state) {
    return counted(fmi == 2 ? (int)fmi2GetFMUstate(x, state) : (int)fmi3GetFMUState(x, state));
}

static int put_back(void *state) {
    return counted(fmi == 2 ? (int)fmi2SetFMUstate(x, state) : (int)fmi3SetFMUState(x, state));
}

static int serialize_to(void *state, unsigned char *to, size_t room) {
    return counted(fmi == 2 ? (int)fmi2SerializeFMUstate(x, state, (char *)to, room)
                            : (int)fmi3SerializeFMUState(x, state, to, room));
}

static int deserialize_from(const unsigned char *from, size_t room, void **state) {
    return counted(fmi == 2 ? (int)fmi2DeSerializeFMUstate(x, (const char *)from, room, state)
                            : (int)fmi3DeserializeFMUState(x, from, room, state));
}

/* --- forged states --- */

static uint32_t crc32(const unsigned char *from, size_t count) {
    uint32_t crc = 0xffffffff;
    for (size_t k = 0; k < count; k++) {
        crc ^= from[k];
        for (int bit = 0; bit < 8; bit++) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

enum { BEFORE = 8 + 16 + 8, BEHIND = 4 };

static size_t head_words(void) { return sizeof(Head) / 8; }

/* A word of the saved state: of all alike, or one that is stored as an integer, or of the records. */
static size_t any_word(void) {
    size_t words = (size - BEFORE - BEHIND) / 8;
    if (below(3) == 0) return below(words);
    if (below(6) == 0) return below(head_words() + model.parameters);
    for (;;) {
        const Rule *rule = model.rules + below(model.rule_count);
        if (rule->rows * rule->columns == 0) continue;
        if (!rule->whole && below(4)) continue;
        return head_words() + model.parameters + rule->first + below(rule->rows) * rule->stride + below(rule->columns);
    }
}

static uint64_t any_bits(uint64_t old) {
    static const int64_t odd[] = {0, 1, -1, 2, -2, 3, 7, 8, 9, 15, 16, 17, 255, 65536, INT32_MAX, INT32_MIN, 1ll << 32,
                                  1ll << 53, INT64_MAX, INT64_MIN};
    union {
        double number;
        uint64_t bits;
    } as;
    switch (below(5)) {
        case 0: return (uint64_t)odd[below(sizeof odd / sizeof *odd)];
        case 1: return old ^ (1ull << below(64));
        case 2: return old + below(5) - 2;
        case 3: as.number = (double)odd[below(sizeof odd / sizeof *odd)]; return as.bits;
        default: as.number = any_number(); return as.bits;
    }
}

static void put_sum(unsigned char *state) {
    uint32_t sum = crc32(state, size - BEHIND);
    memcpy(state + size - BEHIND, &sum, BEHIND);
}

/* Use what has been taken for a state. */
static void live_with(void *state) {
    if (put_back(state) != OK) return;
    if (below(4)) get_all();
    for (int k = 0; k < 2; k++) {
        if (with_exchange) numbers(1), numbers(3), events();
        else step(now(), below(4) ? 1e-3 : 0.05);
    }
    slopes();
    get_all();
    void *again = NULL;
    if (take(&again) == OK) serialize_to(again, bytes, size);
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &again) : (int)fmi3FreeFMUState(x, &again));
}

/* Forge the present state; the instance is then as it was. */
static void forge(long word, uint64_t bits) {
    void *mine = NULL, *theirs = NULL;
    forging = 1;
    if (take(&mine) != OK || serialize_to(mine, bytes, size) != OK) fail("a state cannot be saved");
    unsigned char *changed = apart(bytes, size), *before = apart(bytes, size);
    if (deserialize_from(bytes, size, &theirs) != OK) fail("a state that the FMU has saved is refused");
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &theirs) : (int)fmi3FreeFMUState(x, &theirs));
    for (uint64_t k = word >= 0 ? 1 : 1 + below(4) / 3 * below(3); k > 0; k--) {
        size_t at = word >= 0 ? (size_t)word : any_word();
        if (at == head_words() + most_steps) continue; /* else a step may take its time */
        uint64_t old;
        memcpy(&old, changed + BEFORE + 8 * at, 8);
        uint64_t new = word >= 0 ? bits : any_bits(old);
        memcpy(changed + BEFORE + 8 * at, &new, 8);
    }
    put_sum(changed);
    forged++;
    int taken = deserialize_from(changed, size, &theirs) == OK;
    accepted += (uint64_t)taken;
    void *after = NULL;
    take(&after), serialize_to(after, bytes, size);
    if (memcmp(bytes, before, size)) fail("reading a state has changed the instance");
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &after) : (int)fmi3FreeFMUState(x, &after));
    if (taken) live_with(theirs);
    check_tables();
    if (put_back(mine) != OK) fail("a state that the FMU has saved cannot be restored");
    after = NULL;
    take(&after), serialize_to(after, bytes, size);
    if (memcmp(bytes, before, size)) fail("a restored state is another one");
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &after) : (int)fmi3FreeFMUState(x, &after));
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &theirs) : (int)fmi3FreeFMUState(x, &theirs));
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &mine) : (int)fmi3FreeFMUState(x, &mine));
    free(changed), free(before);
    forging = 0;
}

/* Bytes that are none of a state. */
static void damage(void) {
    int k = (int)below(SLOTS);
    if (!slots[k] || serialize_to(slots[k], bytes, below(4) ? size : below(size)) != OK) return;
    void *theirs = NULL;
    size_t room = below(2) ? size : below(size);
    unsigned char *some = apart(bytes, room);
    if (room && below(2)) some[below(room)] ^= (unsigned char)(1 + below(255));
    if (deserialize_from(room ? some : NULL, room, &theirs) == OK) put_back(theirs);
    counted(fmi == 2 ? (int)fmi2FreeFMUstate(x, &theirs) : (int)fmi3FreeFMUState(x, &theirs));
    free(some);
}

static void other(void) {
    static const char *const categories[] = {"logEvents", "logAll", "logStatusError", "no such", NULL};
    double value;
    const char *text = categories[below(5)];
    fmi2Status status;
    fmi3Clock clock;
    unsigned vr = any_reference();
    switch (below(8)) {
        case 0: counted(fmi == 2 ? (int)fmi2SetDebugLogging(x, (int)below(2), below(2), &text)
                                 : (int)fmi3SetDebugLogging(x, (int)below(2), below(2), &text)); break;
        case 1: if (fmi == 2) counted(fmi2GetRealStatus(x, (fmi2StatusKind)below(4), &value)); break;
        case 2: if (fmi == 2) counted(fmi2GetStatus(x, (fmi2StatusKind)below(4), &status)); break;
        case 3: counted(fmi == 2 ? (int)fmi2CancelStep(x) : (int)fmi3EvaluateDiscreteStates(x)); break;
        case 4: if (fmi == 3) counted(fmi3GetClock(x, &vr, 1, &clock)); break;
        case 5: if (fmi == 3) counted(fmi3UpdateDiscreteStates(x, NULL, NULL, NULL, NULL, NULL, &value)); break;
        case 6: counted(fmi == 2 ? (int)fmi2GetReal(x, NULL, below(3), NULL) : (int)fmi3GetFloat64(x, NULL, below(3), NULL, 1)); break;
        default: counted(fmi == 2 ? (int)fmi2SerializedFMUstateSize(x, NULL, &size) : (int)fmi3SerializedFMUStateSize(x, NULL, &size));
    }
}

static void once(int only_forge) {
    int k = (int)below(SLOTS);
    switch (only_forge ? 0 : below(40)) {
        case 0: forge(-1, 0); break;
        case 1: if (below(6) == 0) unmake(), make(); break;
        case 2: if (below(6) == 0) counted(fmi == 2 ? (int)fmi2Reset(x) : (int)fmi3Reset(x)), begin(1); break;
        case 3: if (below(8) == 0) counted(fmi == 2 ? (int)fmi2Terminate(x) : (int)fmi3Terminate(x)); break;
        case 4: onward((int)below(5), below(4) > 0); break;
        case 5: slopes(); break;
        case 6: free_slot(k); break;
        case 7: put_back(slots[k]); break;
        case 8: damage(); break;
        case 9: case 10: take(&slots[k]); break;
        case 11: case 12: other(); break;
        case 13: onward(3, 1); break;
        case 14: step(any_number(), any_number()); break;
        case 15: case 16: case 17: case 18: case 19: set_some(); break;
        case 20: case 21: case 22: case 23: case 24: case 25: get(); break;
        case 27: case 28: exchange(); break;
        case 29: case 30: case 31: case 32: case 33: case 34: if (with_exchange) { exchange(); break; } /* fall through */
        case 26: step(now(), below(8) ? 0.05 * uniform() : 1e3); break;
        default: step(now(), 2e-3 * uniform());
    }
    if (++done % 32 == 0) check_tables();
    int idle = x->head.phase < STEPPING || x->head.phase == TERMINATED;
    if ((idle && below(8) == 0) || done % 997 == 0) unmake(), make();
}

int main(int count, char **words) {
    if (count < 5 || count % 2 == 0) return 2;
    fmi = atoi(words[1]);
    seed = strtoull(words[2], NULL, 10);
    uint64_t most_calls = strtoull(words[3], NULL, 10), states = strtoull(words[4], NULL, 10);
    while (strcmp(model.variables[model.inputs + model.outputs + most_steps].name, "max_internal_steps")) most_steps++;
    size = serialized_size();
    bytes = malloc(size);
    may_exchange = count == 5;
    make();
    for (int k = 5; k < count; k += 2) {
        while (x->head.phase < STEPPING) unmake(), make();
        step(now(), 1e-2);
        forge(strtol(words[k], NULL, 10), strtoull(words[k + 1], NULL, 16));
    }
    while (calls < most_calls || forged < states) once(calls >= most_calls);
    unmake();
    free(bytes);
    printf("calls %llu more %llu ok %llu discarded %llu refused %llu forged %llu accepted %llu\n",
           (unsigned long long)calls, (unsigned long long)calls_with_forged, (unsigned long long)by_status[OK],
           (unsigned long long)by_status[DISCARD], (unsigned long long)by_status[ERROR], (unsigned long long)forged,
           (unsigned long long)accepted);
    return 0;
}
