/* Life of an instance: made, set up, assembled, stepped, reset, freed. */
#include "instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const PHASES[] = {"instantiated", "initialization", "stepping", "terminated", "event",
                                     "intermediate update", "continuous time"};

static void *room_for(size_t count, size_t size) { return calloc(count, size); }

Instance *make_instance(const char *name, int fmi, void *(*allocate)(size_t, size_t), void (*release)(void *)) {
    if (!allocate || !release) {
        allocate = room_for;
        release = free;
    }
    const int64_t *sizes = (const int64_t *)model.block;
    size_t contacts = (size_t)sizes[SIZE_contacts], unknowns = (size_t)sizes[SIZE_unknowns];
    size_t doubles = 2 * model.parameters + model.numbers + 2 * model.inputs + unknowns + model.words;
    size_t length = name ? strlen(name) : 0;
    Instance *x = allocate(1, sizeof *x + doubles * sizeof(double) + contacts + length + 1);
    if (!x) return NULL;
    x->allocate = allocate;
    x->release = release;
    x->fmi = fmi;
    x->parameters = (double *)(x + 1);
    x->written = x->parameters + model.parameters;
    x->findings = x->written + model.parameters;
    x->states_before = x->findings + model.numbers + 2 * model.inputs;
    x->block = x->states_before + unknowns;
    x->logged_pull = (unsigned char *)(x->block + model.words);
    x->name = (char *)(x->logged_pull + contacts);
    if (length) memcpy(x->name, name, length);
    x->name[length] = 0;
    reset(x);
    return x;
}

void free_instance(Instance *x) { x->release(x); }

void reset(Instance *x) {
    x->head = (Head){.phase = INSTANTIATED, .stop_time = INFINITY, .tolerance = INFINITY, .exchange = x->exchange};
    memcpy(x->block, model.block, model.given * sizeof(double));
    const Variable *parameter = model.variables + model.inputs + model.outputs;
    for (size_t k = 0; k < model.parameters; k++)
        x->parameters[k] = parameter[k].start;
    x->written_tolerance = NAN;
    x->outputs_read = 0;
    forget_news(x);
}

Status require(Instance *x, const char *call, unsigned phases) {
    if (phases & IN(x->head.phase)) return OK;
    char names[160] = ""; /* all of PHASES, and what is between them */
    for (unsigned k = 0; k < sizeof PHASES / sizeof *PHASES; k++) {
        if (!(phases & IN(k))) continue;
        if (*names) strcat(names, " or ");
        strcat(names, PHASES[k]);
    }
    return refuse(x, "%s is not allowed now: the instance is in state %s, not %s.", call, PHASES[x->head.phase], names);
}

Status set_up(Instance *x, const char *call, double start_time, int stop_defined, double stop_time, int tolerance_defined,
              double tolerance) {
    if (!(fabs(start_time) <= LATEST_START))
        return refuse(x,
                      "%s: the start time %g s must be finite and within +-%g s, where the clock still resolves "
                      "microseconds.",
                      call, start_time, LATEST_START);
    if (stop_defined && !(start_time <= stop_time && stop_time < INFINITY))
        return refuse(x, "%s: the stop time %g s must be finite and not before the start time %g s.", call, stop_time,
                      start_time);
    if (tolerance_defined && !(0 < tolerance && tolerance < INFINITY))
        return refuse(x, "%s: the tolerance %g must be positive and finite.", call, tolerance);
    x->head.set_up = 1;
    x->head.start_time = start_time;
    x->head.stop_time = stop_defined ? stop_time : INFINITY;
    x->head.tolerance = tolerance_defined ? tolerance : INFINITY;
    x->head.prepared = 0;
    x->outputs_read = 0;
    return OK;
}

void write_tables(Instance *x) {
    double tolerance = fmax(x->head.tolerance, TIGHTEST);
    if (x->written_tolerance == tolerance &&
        memcmp(x->written, x->parameters, model.parameters * sizeof(double)) == 0)
        return;
    memcpy(x->block, model.block, (size_t)((const int64_t *)x->block)[SLOT_FIRST_OF_STATE] * sizeof(double));
    mechanism_formulas(x->parameters, x->block, x->findings);
    for (size_t k = 0; k < model.numbers; k++)
        if (isnan(x->findings[k])) x->findings[k] = NAN; /* without sign or kind, which some printf show */
    double *relative = FIELD(x, settings) + CODE_RELATIVE_TOLERANCE;
    *relative = fmin(*relative, tolerance);
    memcpy(x->written, x->parameters, model.parameters * sizeof(double));
    x->written_tolerance = tolerance;
}

/* Append those findings that apply. */
static void append_findings(const Instance *x, const Finding *findings, size_t count, char *text, size_t size) {
    for (size_t k = 0; k < count; k++) {
        const double *n = x->findings + findings[k].at;
        if (!(n[0] > 0)) continue;
        size_t length = strlen(text);
        snprintf(text + length, size - length, "%s", length ? " " : "");
        length = strlen(text);
        snprintf(text + length, size - length, findings[k].text, n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]);
    }
}

/* Refuse parameter values that no mechanism can have. */
static Status check_parameters(const Instance *x) {
    char text[2000] = "";
    append_findings(x, model.objections, model.objection_count, text, sizeof text);
    if (!*text) append_findings(x, model.problems, model.problem_count, text, sizeof text);
    if (*text) return refuse(x, "%s", text);
    for (size_t k = 0; k < model.dependent_count; k++)
        if (!isfinite(x->block[model.dependent[k].word]))
            return refuse(x, "The parameters make %s a number that is not finite; change them.", model.dependent[k].label);
    return OK;
}

Status check_values_together(Instance *x, const Head *head, const double *parameters) {
    size_t size = model.parameters * sizeof(double);
    if (memcmp(x->parameters, parameters, size) == 0 && x->head.prepared) return OK;
    double *kept = x->allocate(model.parameters + 1, sizeof(double));
    if (!kept) return refuse(x, "There is no memory for a copy of the parameters.");
    double tolerance = x->head.tolerance;
    memcpy(kept, x->parameters, size);
    memcpy(x->parameters, parameters, size);
    x->head.tolerance = head->tolerance;
    write_tables(x);
    Status status = check_parameters(x);
    memcpy(x->parameters, kept, size);
    x->head.tolerance = tolerance;
    write_tables(x);
    x->release(kept);
    x->outputs_read = 0;
    return status;
}

void forget_motion(const Instance *x, double *state) {
    const int64_t *slot = (const int64_t *)x->block;
    size_t first = (size_t)slot[SLOT_FIRST_OF_STATE], words = (size_t)slot[SLOT_END_OF_STATE] - first;
    size_t inputs = (size_t)slot[SLOT_inputs] - first, slopes = (size_t)slot[SLOT_input_slopes] - first;
    for (size_t k = 0; k < words; k++)
        if (!(k - inputs < model.inputs || k - slopes < model.inputs)) state[k] = model.block[first + k];
}

/* Give the engine's state back its values from before the first call, but for the inputs. */
static void clear_state(Instance *x) {
    const int64_t *slot = (const int64_t *)x->block;
    size_t first = (size_t)slot[SLOT_FIRST_OF_STATE], end = (size_t)slot[SLOT_END_OF_STATE];
    double *kept = x->findings + model.numbers;
    memcpy(kept, FIELD(x, inputs), model.inputs * sizeof(double));
    memcpy(x->block + first, model.block + first, (end - first) * sizeof(double));
    memcpy(FIELD(x, inputs), kept, model.inputs * sizeof(double));
}

static Status failed(Instance *x, int64_t outcome) {
    char details[2000];
    return refuse(x, "%s%s", ADVICE[outcome], advice_details(x, outcome, details, sizeof details));
}

Status prepare(Instance *x) {
    if (x->head.prepared) return OK;
    write_tables(x);
    if (check_parameters(x) != OK) return ERROR;
    /* Slopes of the inputs are for the first step that leads on, which the step to the start time itself is not. */
    double *slopes = x->findings + model.numbers + model.inputs;
    memcpy(slopes, FIELD(x, input_slopes), model.inputs * sizeof(double));
    clear_state(x);
    int64_t words = (int64_t)model.words;
    int64_t outcome = mechanism_begin(x->block, words, x->head.start_time);
    if (outcome == STATUS_OK) outcome = mechanism_begin_step(x->block, words);
    if (outcome == STATUS_OK) outcome = mechanism_go_on(x->block, words, x->head.start_time, CODE_STOP_AT_TARGET);
    memcpy(FIELD(x, input_slopes), slopes, model.inputs * sizeof(double));
    if (outcome != STATUS_OK) return failed(x, outcome);
    forget_news(x); /* while it is not prepared, nothing counts as logged */
    x->logged_impacts = x->logged_events = x->logged_lost = x->logged_passed = 0;
    x->head.prepared = 1;
    return OK;
}

Status initialized(Instance *x) {
    if (prepare(x) != OK) return ERROR;
    for (size_t k = 0; k < model.warning_count; k++) {
        const double *n = x->findings + model.warnings[k].at;
        if (!(n[0] > 0)) continue;
        say(x, WARNING, "logStatusWarning", model.warnings[k].text, n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]);
    }
    x->head.phase = x->exchange ? EVENT : STEPPING;
    log_news(x);
    return OK;
}

Status step_target(Instance *x, const char *call, double current_time, double size, double *target) {
    double reached = time_of(x);
    if (!isfinite(current_time) || !isfinite(size))
        return refuse(x, "%s: time %g s or step size %g s is not a finite number.", call,
                      isnan(current_time) ? NAN : current_time, isnan(size) ? NAN : size);
    if (!(size > 0))
        return refuse(x, "%s: step size %g s must be positive; to go back, restore a saved state.", call, size);
    double rounding = ROUNDINGS * (nextafter(fabs(reached), INFINITY) - fabs(reached));
    if (fabs(current_time - reached) > rounding + fmin(SAME_TIME, SAME_TIME_OF_STEP * size))
        return refuse(x,
                      "%s: the communication point %.12g s is not the time reached, %.12g s; steps follow each other "
                      "without gap, and a step back needs a saved state.",
                      call, current_time, reached);
    *target = current_time + size;
    if (!(*target > reached))
        return refuse(x, "%s: step size %g s is lost in rounding at %.12g s; take larger steps.", call, size, reached);
    if (*target > x->head.stop_time + SAME_TIME * fmax(1.0, fabs(x->head.stop_time)))
        return refuse(x,
                      "%s: the step to %.12g s leads past the stop time %.12g s that the host has given; end there, or "
                      "give a later stop time or none.",
                      call, *target, x->head.stop_time);
    return OK;
}

static Status judge(Instance *x, int64_t outcome) {
    x->outputs_read = 0;
    if (outcome == STATUS_OK) return OK;
    char details[2000];
    advice_details(x, outcome, details, sizeof details);
    if (outcome == STATUS_TOO_MANY_STEPS || outcome == STATUS_NO_PROGRESS)
        return give_up(x, "t = %.9g s: %s%s", time_of(x), ADVICE[outcome], details);
    return refuse(x, "t = %.9g s: %s%s", time_of(x), ADVICE[outcome], details);
}

Status begin_step(Instance *x, double target) {
    for (size_t k = 0; k < model.inputs; k++) {
        const Variable *v = model.variables + k;
        double end = FIELD(x, inputs)[k] + FIELD(x, input_slopes)[k] * (target - time_of(x));
        if (!(v->minimum <= end && end <= v->maximum))
            return refuse(x, "The derivative of %s leads to %g%s at the end of the step, beyond its limits, %g .. %g%s.",
                          v->name, end, v->unit, v->minimum, v->maximum, v->unit);
    }
    return judge(x, mechanism_begin_step(x->block, (int64_t)model.words));
}

Status go_on(Instance *x, double target, int64_t rule) {
    return judge(x, mechanism_go_on(x->block, (int64_t)model.words, target, rule));
}
