/* The engine as a library of its own: what the pythonfmu flavour calls through ctypes. */
#include "engine.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

EXPORT int64_t engine_begin(double *block, int64_t words, double time) { return mechanism_begin(block, words, time); }

EXPORT int64_t engine_begin_step(double *block, int64_t words) { return mechanism_begin_step(block, words); }

EXPORT int64_t engine_go_on(double *block, int64_t words, double target, int64_t rule) {
    return mechanism_go_on(block, words, target, rule);
}

EXPORT int64_t engine_advance(double *block, int64_t words, double target) {
    int64_t outcome = mechanism_begin_step(block, words);
    return outcome == STATUS_OK ? mechanism_go_on(block, words, target, CODE_STOP_AT_TARGET) : outcome;
}

EXPORT void engine_read_outputs(double *block, int64_t words) { mechanism_read_outputs(block, words); }

EXPORT void engine_read_output_rates(double *block, int64_t words) { mechanism_read_output_rates(block, words); }

EXPORT int64_t engine_exchange(double *block, int64_t words, int64_t what, double time) {
    return mechanism_exchange(block, words, what, time);
}

EXPORT void engine_respond(double *block, int64_t words) { mechanism_respond(block, words); }
