/* Log messages of an instance to the host. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "log.h"

static const char *const CATEGORIES[] = LOG_CATEGORIES;
enum { CATEGORY_COUNT = sizeof CATEGORIES / sizeof *CATEGORIES };

static unsigned bit_of(const char *category) {
    for (unsigned k = 0; k < CATEGORY_COUNT; k++)
        if (strcmp(category, CATEGORIES[k]) == 0) return 1u << k;
    return 0;
}

Status set_logging(Instance *x, int on, size_t count, const char *const categories[]) {
    unsigned bits = count == 0 ? ~0u : 0;
    for (size_t k = 0; k < count; k++) {
        unsigned bit = categories && categories[k] ? bit_of(categories[k]) : 0;
        if (!bit)
            return refuse(x, "There is no log category '%s'; see LogCategories in modelDescription.xml.",
                          categories && categories[k] ? categories[k] : "(null)");
        bits |= strcmp(categories[k], "logAll") == 0 ? ~0u : bit;
    }
    unsigned kept = x->fmi == 2 && on ? 0 : x->categories; /* FMI 2.0 chooses categories, FMI 3.0 adds them */
    x->categories = on ? kept | bits : kept & ~bits;
    return OK;
}

void say(const Instance *x, Status status, const char *category, const char *format, ...) {
    if (!x->log || !(x->categories & bit_of(category))) return;
    char text[2400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    x->log(x, status, category, text);
}

/* A text that begins with the instance's name. */
static Status say_named(const Instance *x, Status status, const char *category, const char *format, va_list arguments) {
    char text[2400];
    vsnprintf(text, sizeof text, format, arguments);
    say(x, status, category, "%s: %s", x->name, text);
    return status;
}

Status refuse(const Instance *x, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    Status status = say_named(x, ERROR, "logStatusError", format, arguments);
    va_end(arguments);
    return status;
}

Status give_up(const Instance *x, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    Status status = say_named(x, DISCARD, "logStatusDiscard", format, arguments);
    va_end(arguments);
    return status;
}

/* Whether the singular configuration passed last is behind: the engine may be ahead of it by a step. */
static int is_behind(const Instance *x) {
    return FIELD(x, clock)[CODE_PASSED_AT] <= time_of(x);
}

/* Singular configurations passed so far. */
static int64_t passed(const Instance *x) {
    int64_t count = COUNTERS(x)[CODE_COUNT_PASSED];
    return count > 0 && !is_behind(x) ? count - 1 : count;
}

void forget_news(Instance *x) {
    const int64_t *counters = COUNTERS(x);
    x->logged_impacts = counters[CODE_COUNT_IMPACTS];
    x->logged_events = counters[CODE_COUNT_EVENTS];
    x->logged_lost = counters[CODE_COUNT_LOST];
    x->logged_passed = passed(x);
    for (size_t c = 0; c < SIZE(x, contacts); c++)
        x->logged_pull[c] = x->head.prepared && FIELD(x, pull_time)[c] <= time_of(x);
}

/* Append to a text that has space for `size` bytes. */
static void append(char *text, size_t size, const char *more) {
    size_t length = strlen(text);
    snprintf(text + length, size - length, "%s", more);
}

/* How many more there are than are named. */
static void append_more(char *text, size_t size, const char *between, int count) {
    char more[40];
    snprintf(more, sizeof more, "%s%d more", between, count - MOST_NAMED);
    if (count > MOST_NAMED) append(text, size, more);
}

/* Whether a contact is closed in a mode of an event record, CODE_EVENT_OLD_MODE or CODE_EVENT_NEW_MODE. */
static int is_closed_in(const double *record, int mode, size_t contact) {
    return (int64_t)record[mode + 2 * (contact / CODE_MODE_BITS)] >> contact % CODE_MODE_BITS & 1;
}

static int mode_changes(const Instance *x, const double *record) {
    for (size_t k = CODE_EVENT_OLD_MODE; k < SIZE(x, event); k += 2)
        if (record[k] != record[k + 1]) return 1;
    return 0;
}

/* Names of the closed contacts of a mode: of many, the first, and how many more there are. */
static const char *mode_name(const Instance *x, const double *record, int mode, char *text, size_t size) {
    int count = 0;
    *text = 0;
    for (size_t c = 0; c < SIZE(x, contacts); c++)
        if (is_closed_in(record, mode, c) && count++ < MOST_NAMED) {
            if (*text) append(text, size, "+");
            append(text, size, model.contacts[c].name);
        }
    append_more(text, size, "+", count);
    return *text ? text : "all open";
}

static void name_event(int guard, int subject, char *text, size_t size) {
    static const char *const of_friction[] = {"sticks", "slips", "shock", "several", "undetermined"};
    const char *of_contact = guard == CODE_GUARD_GAP ? "gap" : guard == CODE_GUARD_PUSH       ? "force"
                             : guard == CODE_GUARD_HANDOVER ? "handover"
                                                            : "click";
    if (guard == CODE_GUARD_INPUT) snprintf(text, size, "input");
    else if (guard == CODE_GUARD_FUNCTION) snprintf(text, size, "%s", model.functions[subject]);
    else if (guard == CODE_GUARD_NEXT) snprintf(text, size, "%s.next", model.patterns[subject]);
    else if (guard == CODE_GUARD_PREVIOUS) snprintf(text, size, "%s.previous", model.patterns[subject]);
    else if (guard >= CODE_GUARD_STICK && guard <= CODE_GUARD_UNDETERMINED)
        snprintf(text, size, "%s.%s", model.rubs[subject], of_friction[guard - CODE_GUARD_STICK]);
    else snprintf(text, size, "%s.%s", model.contacts[subject].name, of_contact);
}

/* The place of the first of the new records of those known: those of the start stay for the first step. */
static int64_t first_new(int64_t new_ones, int64_t known) { return new_ones < known ? known - new_ones : 0; }

static void log_impacts(Instance *x, int64_t new_impacts) {
    size_t columns = SIZE(x, record);
    int64_t known = COUNTERS(x)[CODE_COUNT_IN_STEP];
    for (int64_t k = first_new(new_impacts, known); k < known; k++) {
        const double *record = FIELD(x, impacts) + (size_t)k * columns;
        say(x, OK, "logEvents", "Impact on %s at t = %.12g s: closing speed %.6g m/s, impulse %.6g N.s.",
            model.contacts[(int)record[CODE_RECORD_CONTACT]].name, record[CODE_RECORD_TIME],
            record[CODE_RECORD_CLOSING_SPEED], record[CODE_RECORD_IMPULSE]);
    }
}

/* The events that are new; of a step with many, the last ones. */
static void log_events(Instance *x, int64_t new_events) {
    if (!x->log || !(x->categories & bit_of("logEvents"))) return;
    int64_t known = COUNTERS(x)[CODE_EVENTS_IN_STEP];
    if (new_events > known)
        say(x, OK, "logEvents",
            "%lld events of the step to t = %.9g s are not listed one by one; the last %lld follow.",
            (long long)(new_events - known), time_of(x), (long long)known);
    for (int64_t k = first_new(new_events, known); k < known; k++) {
        const double *record = FIELD(x, events) + (size_t)k * SIZE(x, event);
        double impulse = record[CODE_EVENT_IMPULSE];
        char event[200], old_mode[600], new_mode[600], change[1300] = "";
        name_event((int)record[CODE_EVENT_GUARD], (int)record[CODE_EVENT_SUBJECT], event, sizeof event);
        if (mode_changes(x, record) || impulse != 0) /* of friction, and of teeth, there is often none */
            snprintf(change, sizeof change, ": %s -> %s, total impulse %.6g N.s",
                     mode_name(x, record, CODE_EVENT_OLD_MODE, old_mode, sizeof old_mode),
                     mode_name(x, record, CODE_EVENT_NEW_MODE, new_mode, sizeof new_mode), impulse);
        say(x, OK, "logEvents", "Event %s at t = %.12g s%s.", event, record[CODE_EVENT_TIME], change);
    }
}

static void log_passed(Instance *x, int64_t count) {
    char known[60] = "";
    if (is_behind(x))
        snprintf(known, sizeof known, ", the last one at t = %.12g s", FIELD(x, clock)[CODE_PASSED_AT]);
    say(x, OK, "logEvents",
        "Singular configurations passed along the smooth branch in the step to t = %.9g s: %lld%s.", time_of(x),
        (long long)count, known);
}

void log_news(Instance *x) {
    const int64_t *counters = COUNTERS(x);
    if (counters[CODE_COUNT_IMPACTS] != x->logged_impacts)
        log_impacts(x, counters[CODE_COUNT_IMPACTS] - x->logged_impacts);
    if (counters[CODE_COUNT_EVENTS] != x->logged_events) log_events(x, counters[CODE_COUNT_EVENTS] - x->logged_events);
    if (counters[CODE_COUNT_LOST] != x->logged_lost)
        say(x, WARNING, "logStatusWarning",
            "%lld impacts of the step to t = %.9g s did not fit into impacts[1..%zu] and are lost to the outside (the "
            "motion is right); use a shorter communication step.",
            (long long)(counters[CODE_COUNT_LOST] - x->logged_lost), time_of(x), SIZE(x, buffer));
    if (passed(x) != x->logged_passed) log_passed(x, passed(x) - x->logged_passed);
    for (size_t c = 0; c < SIZE(x, contacts); c++)
        if (FIELD(x, pull_time)[c] <= time_of(x) && !x->logged_pull[c])
            say(x, WARNING, "logStatusWarning",
                "From t = %.6g s the guided contact %s pulls: it holds the bodies together where a real contact would "
                "open. The motion from here on is the guided model's, as in the paper.",
                FIELD(x, pull_time)[c], model.contacts[c].name);
    forget_news(x);
}

/* Append, with a comma if it is not the first, by how much a joint or contact is off, if by more than `more_than`. */
static void append_off(char *text, size_t size, int *first, const char *name, double off, double more_than) {
    char part[300];
    if (off <= more_than) return;
    snprintf(part, sizeof part, "%s%s by %.6g", *first ? "" : ", ", name, off);
    append(text, size, part);
    *first = 0;
}

/* By how much joints and closed contacts are off, of those that are so by more than a limit; whether there are any. */
static int residuals(Instance *x, const double *residual, double more_than, char *text, size_t size) {
    size_t row = 0;
    int first = 1;
    for (size_t k = 0; k < SIZE(x, joints); k++) {
        double worst = 0;
        for (int r = 0; r < model.joints[k].rows; r++, row++) {
            double value = residual[row] < 0 ? -residual[row] : residual[row];
            if (!(value <= worst)) worst = value;
        }
        append_off(text, size, &first, model.joints[k].name, worst, more_than);
    }
    for (size_t c = 0; c < SIZE(x, contacts); c++) {
        if (((const int64_t *)FIELD(x, contact_mode))[c] != CODE_CLOSED) continue;
        append_off(text, size, &first, model.contacts[c].name, residual[row] < 0 ? -residual[row] : residual[row],
                   more_than);
        row++;
    }
    return !first;
}

/* A rate as it is shown: nothing where rounding is all there is. */
static double shown(double rate) { return -RATES_WITHIN <= rate && rate <= RATES_WITHIN ? 0 : rate; }

/* The bodies to which the joints give other rates than the start rates; where there are none, the joints. */
static void contradictions(Instance *x, char *text, size_t size) {
    char part[600];
    *part = 0;
    if (residuals(x, FIELD(x, residual_rate), RATES_WITHIN, part, sizeof part)) {
        append(text, size, " No rates near them do; what is left: ");
        append(text, size, part);
        append(text, size, " (m/s, or rad/s). Drivers or closed contacts contradict each other.");
        return;
    }
    size_t n = SIZE(x, coordinates);
    const char *before = " They ask for other ones: ";
    for (size_t k = 0; k < n; k += 3) {
        const double *given = FIELD(x, body_start_rate) + k, *asked = FIELD(x, y_end) + n + k;
        if (shown(asked[0] - given[0]) == 0 && shown(asked[1] - given[1]) == 0 && shown(asked[2] - given[2]) == 0)
            continue;
        snprintf(part, sizeof part, "%sbody '%s' (%.6g, %.6g, %.6g), not (%.6g, %.6g, %.6g)", before,
                 model.bodies[k / 3], shown(asked[0]), shown(asked[1]), shown(asked[2]), shown(given[0]),
                 shown(given[1]), shown(given[2]));
        append(text, size, part);
        before = ", ";
    }
    append(text, size,
           " (of its centre of mass in m/s, and rad/s). Name in held the coordinate whose rate you mean, as "
           "'crank.angle', and leave out the rates that should follow; those of driven bodies follow without held.");
}

/* Which driver is at the end of its range, and what it asks for there. */
static void driven_too_far(Instance *x, char *text, size_t size) {
    const Joint *driver = model.joints + *(const int64_t *)FIELD(x, stage_stiffest);
    snprintf(text, size, " Driver '%s' asks for %.6g %s here, and goes on.", driver->name,
             FIELD(x, residual)[SIZE(x, rows) - 1], driver->unit);
}

static void penetration(Instance *x, int64_t which, const char *way_out, char *text, size_t size) {
    const Contact *contact = model.contacts + which;
    double depth = -FIELD(x, residual)[SIZE(x, rows) - 1];
    snprintf(text, size, " Contact '%s': %s %.6g %s%s.", contact->name, contact->before, depth, contact->behind,
             way_out);
}

/* The contacts that a failed event is about: those of the step's events, and the closed ones. */
static void involved_contacts(Instance *x, char *text, size_t size) {
    int count = 0;
    for (size_t c = 0; c < SIZE(x, contacts); c++) {
        int closed = ((const int64_t *)FIELD(x, contact_mode))[c] == CODE_CLOSED;
        for (int64_t k = 0; k < COUNTERS(x)[CODE_EVENTS_IN_STEP] && !closed; k++) {
            const double *record = FIELD(x, events) + (size_t)k * SIZE(x, event);
            closed = is_closed_in(record, CODE_EVENT_OLD_MODE, c) || is_closed_in(record, CODE_EVENT_NEW_MODE, c);
        }
        if (!closed || count++ >= MOST_NAMED) continue;
        append(text, size, count == 1 ? " Contacts: " : ", ");
        append(text, size, model.contacts[c].name);
    }
    append_more(text, size, ", ", count);
    if (count) append(text, size, ".");
}

/* What rubs: coefficient, the angle of its bodies to each other, and Painleve's criterion where it slips. */
static void friction(Instance *x, char *text, size_t size) {
    int first = 1;
    size_t contacts = SIZE(x, contacts);
    for (size_t k = 0; k < SIZE(x, rubs) && k < contacts + SIZE(x, joints); k++) {
        int contact = k < contacts;
        size_t place = contact ? k : k - contacts;
        double value = contact ? FIELD(x, contact_value)[place * CODE_CONTACT_VALUES + CODE_FRICTION] : FIELD(x, joint_friction)[place];
        int64_t slip = ((const int64_t *)FIELD(x, rub_slip))[k];
        if (!(value > 0) || slip == CODE_APART) continue;
        int64_t i = ((const int64_t *)(contact ? FIELD(x, contact_body_i) : FIELD(x, joint_body_i)))[place];
        int64_t j = ((const int64_t *)(contact ? FIELD(x, contact_body_j) : FIELD(x, joint_body_j)))[place];
        double angle = (i < 0 ? 0 : FIELD(x, y_end)[3 * i + 2]) - (j < 0 ? 0 : FIELD(x, y_end)[3 * j + 2]);
        char one[400];
        snprintf(one, sizeof one, "%s%s (%.6g, at %.6g rad", first ? " Friction: " : ", ", model.rubs[k], value, angle);
        append(text, size, one);
        if (slip == CODE_STICKS) snprintf(one, sizeof one, ", sticks)");
        else snprintf(one, sizeof one, ", slips, A/G = %.3g)", FIELD(x, rub_criterion)[k]);
        append(text, size, one);
        first = 0;
    }
    if (!first) append(text, size, ".");
}

/* How small the steps have become, and the part whose error limits them. */
static void stiffest(Instance *x, char *text, size_t size) {
    long long events = COUNTERS(x)[CODE_EVENTS_IN_STEP];
    snprintf(text, size, " Internal steps: %lld, the last of %.3g s, limited by %s. Events: %lld%s.",
             (long long)COUNTERS(x)[CODE_STEPS_IN_STEP], FIELD(x, tried)[1],
             model.unknowns[*(const int64_t *)FIELD(x, stage_stiffest)], events,
             events == (long long)SIZE(x, event_buffer) ? " or more" : "");
}

const char *advice_details(Instance *x, int64_t outcome, char *text, size_t size) {
    *text = 0;
    if (outcome == STATUS_TOO_MANY_STEPS || outcome == STATUS_NO_PROGRESS || outcome == STATUS_STEP_TOO_SMALL)
        stiffest(x, text, size);
    if (outcome == STATUS_NOT_ASSEMBLED) {
        append(text, size, " Left open: ");
        residuals(x, FIELD(x, residual), -1, text, size);
        append(text, size, " (m, or rad between directions).");
    }
    if (outcome == STATUS_START_RATES) contradictions(x, text, size);
    if (outcome == STATUS_OUT_OF_REACH) driven_too_far(x, text, size);
    if (outcome == STATUS_AT_CENTRE)
        snprintf(text, size, " Contact '%s'.", model.contacts[COUNTERS(x)[CODE_PENDING_SUBJECT]].name);
    if (outcome == STATUS_START_INSIDE || outcome == STATUS_OVERLAP)
        penetration(x, COUNTERS(x)[CODE_PENDING_SUBJECT], "; change the start angles or the lengths", text, size);
    if (outcome == STATUS_PENETRATED || outcome == STATUS_PASSED_OVER)
        penetration(x, ((const int64_t *)FIELD(x, stage_stiffest))[0], "", text, size);
    if (outcome == STATUS_FORCE_PASSED_OVER)
        snprintf(text, size, " Force element '%s'.", model.elements[((const int64_t *)FIELD(x, stage_stiffest))[0]]);
    if (outcome == STATUS_CHATTERING || outcome == STATUS_NO_CHOICE || outcome == STATUS_JAMMED ||
        outcome == STATUS_ROW_AWAY || outcome == STATUS_NO_CONTACT_POINT || outcome == STATUS_BRIDGED ||
        outcome == STATUS_FEW_POINTS)
        involved_contacts(x, text, size);
    if (outcome == STATUS_JAMMED || outcome == STATUS_NO_CHOICE) friction(x, text, size);
    return text;
}
