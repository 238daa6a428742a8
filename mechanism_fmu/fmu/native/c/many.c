/* Many designs of one model: every thread calls this once, with a block of its own, and takes design after design. */
#include <string.h>

#include "engine.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

/* As in mechanism_fmu/batch/job.py, which explains it. */
typedef struct {
    int64_t words, given_words, designs, varied, points, driven, read, fields, kept, until_impact;
    const double *given;
    const int64_t *varied_word;
    const double *varied_value;
    const double *times;
    const int64_t *driven_word;
    const double *driven_value;
    const int64_t *read_output;
    const int64_t *impact_field;
    double *values, *least, *greatest;
    double *impacts;
    double *reached, *pulled;
    int64_t *impact_count;
    int64_t *status;
    int64_t *next;
    int64_t *events, *event_count;
    int64_t kept_events;
} Job;

#define FIELD(block, name) ((block) + ((const int64_t *)(block))[SLOT_##name])
#define SIZE(block, name) (((const int64_t *)(block))[SIZE_##name])
#define COUNTERS(block) ((int64_t *)FIELD(block, counters))

static void drive(const Job *job, double *block, int64_t point) {
    for (int64_t k = 0; k < job->driven; k++)
        block[job->driven_word[k]] = job->driven_value[point * job->driven + k];
}

/* Keep the impacts since there were `seen`; they are the last ones of the buffer. */
static int64_t keep_impacts(const Job *job, const double *block, int64_t design, int64_t seen) {
    const int64_t *counters = (const int64_t *)(block + ((const int64_t *)block)[SLOT_counters]);
    int64_t count = counters[CODE_COUNT_IMPACTS], held = counters[CODE_COUNT_IN_STEP];
    for (int64_t k = seen; k < count && k < job->kept; k++) {
        int64_t place = held - (count - k);
        if (place < 0) continue; /* more at once than the buffer holds */
        place = (place + counters[CODE_FIRST_IMPACT]) % SIZE(block, buffer); /* the buffer goes round */
        const double *record = FIELD(block, impacts) + place * SIZE(block, record);
        for (int64_t f = 0; f < job->fields; f++)
            job->impacts[(design * job->kept + k) * job->fields + f] = record[job->impact_field[f]];
    }
    job->impact_count[design] = count;
    return count;
}

static void keep_event(const Job *job, int64_t design, int64_t guard, int64_t subject) {
    int64_t place = job->event_count[design]++;
    if (place >= job->kept_events) return;
    int64_t *event = job->events + (design * job->kept_events + place) * 2;
    event[0] = guard;
    event[1] = subject;
}

/* How the motion begins, as events: the contacts that are closed, and behind their numbers what sticks. */
static void keep_beginning(const Job *job, const double *block, int64_t design) {
    const int64_t *mode = (const int64_t *)(block + ((const int64_t *)block)[SLOT_contact_mode]);
    const int64_t *slip = (const int64_t *)(block + ((const int64_t *)block)[SLOT_rub_slip]);
    int64_t contacts = SIZE(block, contacts);
    for (int64_t c = 0; c < contacts; c++)
        if (mode[c] == CODE_CLOSED) keep_event(job, design, CODE_GUARD_BEGIN, c);
    for (int64_t k = 0; k < SIZE(block, rubs); k++)
        if (slip[k] == CODE_STICKS) keep_event(job, design, CODE_GUARD_BEGIN, contacts + k);
}

/* Keep the events since there were `seen`; they are the last ones of the buffer. */
static int64_t keep_events(const Job *job, const double *block, int64_t design, int64_t seen) {
    const int64_t *counters = (const int64_t *)(block + ((const int64_t *)block)[SLOT_counters]);
    int64_t count = counters[CODE_COUNT_EVENTS], held = counters[CODE_EVENTS_IN_STEP];
    for (int64_t k = seen; k < count; k++) {
        int64_t place = held - (count - k);
        const double *record = FIELD(block, events) + place * SIZE(block, event);
        if (place < 0) keep_event(job, design, CODE_GUARD_NONE, CODE_NONE); /* more at once than the buffer holds */
        else keep_event(job, design, (int64_t)record[CODE_EVENT_GUARD], (int64_t)record[CODE_EVENT_SUBJECT]);
    }
    return count;
}

/* Where the motion has come to: widen the extremes, if they are asked for. */
static void look(const Job *job, double *block, int64_t design) {
    if (!job->least) return;
    mechanism_read_outputs(block, job->words);
    for (int64_t k = 0; k < job->read; k++) {
        double value = FIELD(block, outputs)[job->read_output[k]];
        double *least = job->least + design * job->read + k, *greatest = job->greatest + design * job->read + k;
        if (!(*least <= value)) *least = value; /* NaN before the first */
        if (!(*greatest >= value)) *greatest = value;
    }
}

static int64_t run(const Job *job, double *block, int64_t design) {
    memcpy(block, job->given, (size_t)job->given_words * sizeof(double));
    for (int64_t k = 0; k < job->varied; k++)
        block[job->varied_word[k]] = job->varied_value[design * job->varied + k];
    drive(job, block, 0);
    int64_t outcome = mechanism_begin(block, job->words, job->times[0]);
    if (outcome == STATUS_OK) outcome = mechanism_begin_step(block, job->words);
    if (outcome == STATUS_OK) outcome = mechanism_go_on(block, job->words, job->times[0], CODE_STOP_AT_TARGET);
    if (outcome != STATUS_OK) return outcome;
    const double *time = FIELD(block, clock) + CODE_TIME;
    job->reached[design] = *time;
    look(job, block, design);
    int64_t impacts = 0, events = 0;
    int64_t rule = job->kept_events ? CODE_STOP_AT_IMPACT + CODE_STOP_AT_EVENT : CODE_STOP_AT_IMPACT;
    if (job->kept_events) {
        keep_beginning(job, block, design);
        events = keep_events(job, block, design, 0);
    }
    for (int64_t point = 0; point < job->points; point++) {
        drive(job, block, point);
        outcome = mechanism_begin_step(block, job->words);
        do {
            if (outcome == STATUS_OK)
                outcome = mechanism_go_on(block, job->words, job->times[point + 1], rule);
            job->reached[design] = *time;
            if (COUNTERS(block)[CODE_COUNT_IMPACTS] > impacts) impacts = keep_impacts(job, block, design, impacts);
            if (job->kept_events) events = keep_events(job, block, design, events);
            if (outcome != STATUS_OK) return outcome;
        } while (*time < job->times[point + 1] && !(job->until_impact && impacts));
        look(job, block, design);
        if (job->until_impact && impacts) break;
    }
    int64_t contacts = SIZE(block, contacts);
    for (int64_t c = 0; c < contacts; c++) {
        double pulls = FIELD(block, pull_time)[c];
        if (pulls <= *time) job->pulled[design * contacts + c] = pulls;
    }
    mechanism_read_outputs(block, job->words);
    for (int64_t k = 0; k < job->read; k++)
        job->values[design * job->read + k] = FIELD(block, outputs)[job->read_output[k]];
    return STATUS_OK;
}

/* Run designs until none is left that no other thread has taken. `block` is scratch, job->words long. */
EXPORT void engine_many(const Job *job, double *block) {
    for (;;) {
        int64_t design = __atomic_fetch_add(job->next, 1, __ATOMIC_RELAXED);
        if (design >= job->designs) return;
        if (job->status[design] == STATUS_OK) job->status[design] = run(job, block, design);
    }
}
