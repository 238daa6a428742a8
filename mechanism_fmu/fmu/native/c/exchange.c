/* Model Exchange (FMI 2.0, chapter 3; FMI 3.0, chapter 3): the states are the engine's y, the events are its own. */
#include "exchange.h"

#include <math.h>
#include <string.h>

/* A page co-simulates, and asks for what the model has by name only: what else is here would be a tenth of its module. */
#ifdef MODEL_IS_LOADED
enum { ON_A_PAGE = 1 };
#else
enum { ON_A_PAGE = 0 };
#endif

#define RUNNING (IN(EVENT) | IN(CONTINUOUS))

static size_t state_count(const Instance *x) { return SIZE(x, unknowns); }

static size_t indicator_count(const Instance *x) { return SIZE(x, indicators); }

static int64_t ask(Instance *x, int64_t what) {
    x->outputs_read = 0;
    if (ON_A_PAGE) return STATUS_OK;
    return mechanism_exchange(x->block, (int64_t)model.words, what, time_of(x));
}

static Status fail(Instance *x, const char *call, int64_t outcome, Status status) {
    char details[2000];
    advice_details(x, outcome, details, sizeof details);
    if (status == DISCARD) {
        say(x, DISCARD, "logStatusDiscard", "%s: t = %.9g s: %s%s", call, time_of(x), ADVICE[outcome], details);
        return DISCARD;
    }
    return refuse(x, "t = %.9g s: %s%s", time_of(x), ADVICE[outcome], details);
}

/* In the phases given, and as many values as there are. */
static Status check_numbers(Instance *x, const char *call, unsigned phases, const void *values, size_t count,
                            size_t expected) {
    if (!x->exchange) return refuse(x, "%s: the instance was made for co-simulation.", call);
    if (require(x, call, phases) != OK) return ERROR;
    if (count != expected) return refuse(x, "%s: %zu values were asked for, and there are %zu.", call, count, expected);
    if (count > 0 && !values) return refuse(x, "%s: the pointer to the values is null.", call);
    return OK;
}

static Status check(Instance *x, const char *call, unsigned phases, const void *values, size_t count, size_t expected) {
    return check_numbers(x, call, phases, values, count, expected) == OK ? prepare(x) : ERROR;
}

Status enter_events(Instance *x, const char *call) {
    if (check(x, call, IN(CONTINUOUS), NULL, 0, 0) != OK) return ERROR;
    x->head.phase = EVENT;
    x->head.updated = 0;
    return OK;
}

Status update_events(Instance *x, const char *call, EventNews *news) {
    if (check(x, call, IN(EVENT), NULL, 0, 0) != OK) return ERROR;
    size_t size = state_count(x) * sizeof(double);
    memcpy(x->states_before, FIELD(x, y_end), size);
    int64_t outcome = ask(x, x->head.updated ? CODE_EXCHANGE_MORE_EVENTS : CODE_EXCHANGE_EVENTS);
    x->head.updated = 1;
    log_news(x);
    if (outcome != STATUS_OK) return fail(x, call, outcome, ERROR);
    news->states_changed = memcmp(x->states_before, FIELD(x, y_end), size) != 0;
    news->next_time = time_of(x) + FIELD(x, exchange_next_piece)[0];
    return OK;
}

Status enter_continuous(Instance *x, const char *call) {
    if (check(x, call, IN(EVENT), NULL, 0, 0) != OK) return ERROR;
    x->head.phase = CONTINUOUS;
    return OK;
}

Status complete_step(Instance *x, const char *call, int *wants_events) {
    if (check(x, call, IN(CONTINUOUS), NULL, 0, 0) != OK) return ERROR;
    int64_t outcome = ask(x, CODE_EXCHANGE_COMPLETED);
    log_news(x);
    if (outcome != STATUS_OK) return fail(x, call, outcome, ERROR);
    *wants_events = ((const int64_t *)FIELD(x, exchange_wants_events))[0] != 0;
    return OK;
}

Status set_instant(Instance *x, const char *call, double time) {
    if (check(x, call, RUNNING, NULL, 0, 0) != OK) return ERROR;
    if (!isfinite(time)) return refuse(x, "%s: the time is not a finite number.", call);
    double *clock = FIELD(x, clock);
    clock[CODE_TIME] = clock[CODE_STEP_START] = clock[CODE_STEP_END] = time;
    clock[CODE_STEP_SIZE] = 0;
    x->outputs_read = 0;
    return OK;
}

Status set_states(Instance *x, const char *call, const double states[], size_t count) {
    if (check(x, call, IN(CONTINUOUS), states, count, state_count(x)) != OK) return ERROR;
    for (size_t k = 0; k < count; k++)
        if (!isfinite(states[k])) {
            say(x, DISCARD, "logStatusDiscard", "%s: state %zu is not a finite number.", call, k + 1);
            return DISCARD;
        }
    memcpy(FIELD(x, y_end), states, count * sizeof(double));
    x->outputs_read = 0;
    return OK;
}

Status get_states(Instance *x, const char *call, double states[], size_t count) {
    if (check(x, call, IN(INITIALIZATION) | RUNNING | IN(TERMINATED), states, count, state_count(x)) != OK) return ERROR;
    memcpy(states, FIELD(x, y_end), count * sizeof(double));
    return OK;
}

Status get_derivatives(Instance *x, const char *call, double derivatives[], size_t count) {
    if (check(x, call, IN(INITIALIZATION) | RUNNING | IN(TERMINATED), derivatives, count, state_count(x)) != OK)
        return ERROR;
    int64_t outcome = ask(x, CODE_EXCHANGE_RATES);
    if (outcome != STATUS_OK) return fail(x, call, outcome, DISCARD);
    memcpy(derivatives, FIELD(x, dy_end), count * sizeof(double));
    return OK;
}

Status get_nominals(Instance *x, const char *call, double nominals[], size_t count) {
    unsigned phases = IN(INSTANTIATED) | IN(INITIALIZATION) | RUNNING | IN(TERMINATED);
    if (check_numbers(x, call, phases, nominals, count, state_count(x)) != OK) return ERROR;
    memcpy(nominals, model.nominals, count * sizeof(double));
    return OK;
}

Status get_indicators(Instance *x, const char *call, double indicators[], size_t count) {
    if (check(x, call, IN(INITIALIZATION) | RUNNING | IN(TERMINATED), indicators, count, indicator_count(x)) != OK)
        return ERROR;
    ask(x, CODE_EXCHANGE_INDICATORS);
    memcpy(indicators, FIELD(x, exchange_indicator), count * sizeof(double));
    for (size_t k = 0; k < count; k++)
        if (!isfinite(indicators[k])) {
            say(x, DISCARD, "logStatusDiscard", "%s: at t = %.9g s nothing finite comes of the states.", call, time_of(x));
            return DISCARD;
        }
    return OK;
}

/* --- as variables --- */

static size_t first_exchanged(const Instance *x) {
    return x->fmi == 2 ? model.variable_count + 1 : TIME_REFERENCE + 1 + (model.has_clock ? 1 + model.again_count : 0);
}

unsigned last_exchanged(const Instance *x) {
    size_t indicators = x->fmi == 3 ? indicator_count(x) : 0;
    return (unsigned)(first_exchanged(x) + 2 * state_count(x) + indicators - 1);
}

int is_exchanged(const Instance *x, unsigned vr) {
    return !ON_A_PAGE && vr >= first_exchanged(x) && vr <= last_exchanged(x);
}

/* In co-simulation, where the engine may be ahead of the time reached, states are those at this time. */
double exchanged(Instance *x, unsigned vr) {
    size_t k = vr - first_exchanged(x), n = state_count(x);
    if (!ON_A_PAGE && k < 2 * n) {
        mechanism_read_output_rates(x->block, (int64_t)model.words);
        return k < n ? FIELD(x, y_at)[k] : FIELD(x, dy_at)[k - n];
    }
    if (!x->exchange) return 1; /* the engine finds its events by itself */
    ask(x, CODE_EXCHANGE_INDICATORS);
    return FIELD(x, exchange_indicator)[k - 2 * n];
}

/* --- directional derivatives --- */

/* Where the derivative of an unknown stands: of an output that varies continuously, or of a state's derivative, which in
   co-simulation, where the engine may be ahead, is none. */
static Status unknown_place(Instance *x, const char *call, unsigned vr, size_t *place) {
    size_t k = vr - first_exchanged(x), n = state_count(x);
    if (x->exchange && is_exchanged(x, vr) && k >= n && k < 2 * n) {
        *place = SIZE(x, outputs) + (k - n); /* behind calculated parameters */
        return OK;
    }
    size_t output = vr - 1 - model.inputs;
    if (vr > model.inputs && output < model.outputs && model.variables[vr - 1].continuous) {
        *place = output;
        return OK;
    }
    return refuse(x, "%s: the variable with value reference %u is no continuous output%s.", call, vr,
                  x->exchange ? " and no derivative of a state" : "; derivatives of states are for Model Exchange");
}

/* Where the seed of a known stands: of an input, or in Model Exchange of a state. */
static double *known_place(Instance *x, const char *call, unsigned vr) {
    if (vr >= 1 && vr <= model.inputs) return FIELD(x, input_seed) + (vr - 1);
    if (x->exchange && is_exchanged(x, vr) && vr - first_exchanged(x) < state_count(x))
        return FIELD(x, state_seed) + (vr - first_exchanged(x));
    refuse(x, "%s: the variable with value reference %u is no input%s.", call, vr,
           x->exchange ? " and no state" : "; derivatives by states are for Model Exchange");
    return NULL;
}

/* What both derivatives begin with: pointers, phase, unknowns that have one, and no seeds yet. */
static Status ready(Instance *x, const char *call, const unsigned unknown[], size_t unknowns, const unsigned known[],
                    size_t knowns, const double seed[], size_t seeds, const double value[]) {
    if ((unknowns && !unknown) || (knowns && !known) || (seeds && !seed) || !value)
        return refuse(x, "%s: a pointer is null.", call);
    if (require(x, call, IN(INITIALIZATION) | IN(STEPPING) | RUNNING | IN(TERMINATED)) != OK || prepare(x) != OK)
        return ERROR;
    size_t place;
    int64_t *asked = (int64_t *)FIELD(x, asked);
    memset(asked, 0, (size_t)(SIZE(x, outputs) + state_count(x)) * sizeof(int64_t));
    for (size_t k = 0; k < unknowns; k++) {
        if (unknown_place(x, call, unknown[k], &place) != OK) return ERROR;
        asked[place] = 1;
    }
    memset(FIELD(x, input_seed), 0, model.inputs * sizeof(double));
    memset(FIELD(x, state_seed), 0, state_count(x) * sizeof(double));
    x->outputs_read = 0;
    return OK;
}

static Status check_finite(Instance *x, const char *call, double value) {
    if (isfinite(value)) return OK;
    say(x, DISCARD, "logStatusDiscard", "%s: there is no derivative here: nothing finite comes of a small change.", call);
    return DISCARD;
}

Status directional(Instance *x, const char *call, const unsigned unknown[], size_t unknowns, const unsigned known[],
                   size_t knowns, const double seed[], double value[]) {
    if (unknowns == 0) return OK;
    if (ready(x, call, unknown, unknowns, known, knowns, seed, knowns, value) != OK) return ERROR;
    size_t place;
    for (size_t k = 0; k < knowns; k++) {
        double *to = known_place(x, call, known[k]);
        if (!to) return ERROR;
        *to += seed[k];
    }
    mechanism_respond(x->block, (int64_t)model.words);
    for (size_t k = 0; k < unknowns; k++) {
        unknown_place(x, call, unknown[k], &place);
        value[k] = FIELD(x, response)[place];
        if (check_finite(x, call, value[k]) != OK) return DISCARD;
    }
    return OK;
}

/* A derivative for each known, one after the other. */
Status adjoint(Instance *x, const char *call, const unsigned unknown[], size_t unknowns, const unsigned known[],
               size_t knowns, const double seed[], double value[]) {
    if (knowns == 0) return OK;
    if (ready(x, call, unknown, unknowns, known, knowns, seed, unknowns, value) != OK) return ERROR;
    size_t place;
    for (size_t k = 0; k < knowns; k++) {
        double *to = known_place(x, call, known[k]);
        if (!to) return ERROR;
        *to = 1;
        mechanism_respond(x->block, (int64_t)model.words);
        *to = 0;
        value[k] = 0;
        for (size_t u = 0; u < unknowns; u++) {
            unknown_place(x, call, unknown[u], &place);
            value[k] += seed[u] * FIELD(x, response)[place];
        }
        if (check_finite(x, call, value[k]) != OK) return DISCARD;
    }
    return OK;
}
