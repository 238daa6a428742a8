/* Whether bytes from outside may be a state: asked before any of them reaches an instance. As in admissible.py. */
#include <math.h>

#include "instance.h"
#include "saved.h"

static const char CHANGED[] = "The saved state is not one that this model can be in: ";

static Status check_word(const Instance *x, const Rule *rule, const double *word) {
    double value = rule->integer ? (double)*(const int64_t *)word : *word;
    if (rule->nan && isnan(value)) return OK;
    if (rule->low <= value && value <= rule->high && (!rule->whole || value == floor(value))) return OK;
    return refuse(x, "%s%s is %g instead of a %snumber from %g to %g.", CHANGED, rule->name,
                  isnan(value) ? NAN : value, rule->whole ? "whole " : "", rule->low, rule->high);
}

static Status check_words(const Instance *x, const double *state) {
    for (size_t k = 0; k < model.rule_count; k++)
        for (size_t row = 0; row < model.rules[k].rows; row++)
            for (size_t column = 0; column < model.rules[k].columns; column++) {
                size_t word = model.rules[k].first + row * model.rules[k].stride + column;
                if (check_word(x, model.rules + k, state + word) != OK) return ERROR;
            }
    return OK;
}

static int rubs(int64_t guard) { return guard >= CODE_GUARD_STICK && guard <= CODE_GUARD_UNDETERMINED; }

static int has_subject(int64_t guard) {
    return (guard >= CODE_GUARD_GAP && guard <= CODE_GUARD_FUNCTION) || rubs(guard) || guard == CODE_GUARD_HANDOVER;
}

/* Whether a guard can be about a subject. */
static int fits(const Instance *x, int64_t guard, int64_t subject) {
    size_t count = guard == CODE_GUARD_NEXT || guard == CODE_GUARD_PREVIOUS ? SIZE(x, patterns)
                   : guard == CODE_GUARD_FUNCTION                           ? SIZE(x, functions)
                   : rubs(guard)                                            ? SIZE(x, rubs)
                                                                            : SIZE(x, contacts);
    if (has_subject(guard)) return subject >= 0 && (size_t)subject < count;
    return subject == CODE_NONE;
}

/* Where a field begins in a state that stands elsewhere. */
#define OF_STATE(x, state, name) \
    ((state) + (((const int64_t *)(x)->block)[SLOT_##name] - ((const int64_t *)(x)->block)[SLOT_FIRST_OF_STATE]))

static int event_failure(int64_t outcome) {
    static const int64_t failures[] = EVENT_FAILURES;
    for (size_t k = 0; k < sizeof failures / sizeof *failures; k++)
        if (failures[k] == outcome) return 1;
    return 0;
}

/* Words that may each stand where they are, but not together. */
static Status check_together(const Instance *x, const double *state) {
    const double *clock = OF_STATE(x, state, clock);
    const int64_t *counters = (const int64_t *)OF_STATE(x, state, counters);
    int64_t guard = counters[CODE_PENDING_GUARD], subject = counters[CODE_PENDING_SUBJECT];
    if (guard == CODE_GUARD_FAILED ? !event_failure(subject) : !fits(x, guard, subject))
        return refuse(x, "%sits pending event %lld cannot be about %lld.", CHANGED, (long long)guard, (long long)subject);
    if (clock[CODE_TIME] < clock[CODE_STEP_END] && !(clock[CODE_STEP_SIZE] > 0))
        return refuse(x, "%sits time lies in an internal step of no length.", CHANGED);
    const double *impacts = OF_STATE(x, state, impacts), *events = OF_STATE(x, state, events);
    for (size_t k = 0; k < (size_t)counters[CODE_COUNT_IN_STEP]; k++)
        if (impacts[k * SIZE(x, record) + CODE_RECORD_CONTACT] < 0)
            return refuse(x, "%sit counts an impact without a contact.", CHANGED);
    for (size_t k = 0; k < (size_t)counters[CODE_EVENTS_IN_STEP]; k++) {
        guard = (int64_t)events[k * SIZE(x, event) + CODE_EVENT_GUARD];
        subject = (int64_t)events[k * SIZE(x, event) + CODE_EVENT_SUBJECT];
        if (!(has_subject(guard) || guard == CODE_GUARD_INPUT) || !fits(x, guard, subject))
            return refuse(x, "%sits event %lld cannot be about %lld.", CHANGED, (long long)guard, (long long)subject);
    }
    return OK;
}

static Status check_head(const Instance *x, const Head *head) {
    unsigned phases = IN(INSTANTIATED) | IN(INITIALIZATION) | IN(TERMINATED);
    phases |= head->exchange ? IN(EVENT) | IN(CONTINUOUS) : x->fmi == 3 ? IN(STEPPING) | IN(EVENT) : IN(STEPPING);
    int running = head->phase >= STEPPING;
    if (head->phase < INSTANTIATED || head->phase > CONTINUOUS || !(IN(head->phase) & phases))
        return refuse(x, "%sthere is no phase %lld.", CHANGED, (long long)head->phase);
    if ((head->set_up | head->prepared | head->clock | head->left | head->exchange | head->updated) & ~(int64_t)1)
        return refuse(x, "%sa flag is neither 0 nor 1.", CHANGED);
    if ((running && !head->prepared) || (head->phase != INSTANTIATED && !head->set_up))
        return refuse(x, "%sit is in phase %lld, but was not set up or did not begin.", CHANGED, (long long)head->phase);
    if (!(fabs(head->start_time) <= LATEST_START) || !(head->start_time <= head->stop_time) || !(head->tolerance > 0))
        return refuse(x, "%sits experiment is from %g s to %g s with tolerance %g.", CHANGED, head->start_time,
                      head->stop_time, head->tolerance);
    return OK;
}

/* An input with a slope may end beyond its limit by rounding. */
static Status check_value(const Instance *x, const Variable *v, double value, double slack) {
    double rounding = slack * fmax(1.0, fabs(value));
    int whole = v->type == REAL || value == floor(value);
    int flag = v->type != BOOLEAN || value == 0 || value == 1;
    if (isfinite(value) && v->minimum - rounding <= value && value <= v->maximum + rounding && whole && flag) return OK;
    return refuse(x, "%s%s = %g%s is not within its limits, %g .. %g%s.", CHANGED, v->name, isnan(value) ? NAN : value,
                  v->unit, v->minimum, v->maximum, v->unit);
}

Status check_saved(Instance *x, const Head *head, const double *parameters, double *state) {
    if (check_head(x, head) != OK) return ERROR;
    for (size_t k = 0; k < model.parameters; k++)
        if (check_value(x, model.variables + model.inputs + model.outputs + k, parameters[k], 0) != OK) return ERROR;
    for (size_t k = 0; k < model.inputs; k++) {
        if (check_value(x, model.variables + k, OF_STATE(x, state, inputs)[k], SAME_TIME) != OK) return ERROR;
        if (!isfinite(OF_STATE(x, state, input_slopes)[k]))
            return refuse(x, "%sthe derivative of %s is not a finite number.", CHANGED, model.variables[k].name);
    }
    if (!head->prepared) {
        forget_motion(x, state);
        return OK;
    }
    if (check_words(x, state) != OK || check_together(x, state) != OK) return ERROR;
    return check_values_together(x, head, parameters);
}
