/* One FMU for Model Exchange in FMI Library: integrated with equal steps of Runge and Kutta's method of order 4, cut at
   state events by bisection; and the values of some variables at the end, each on a line.

   Usage: fmi_library_exchange FMU EMPTY_FOLDER STEP STEPS NAME ...

   STEP is divided by PARTS. Whatever FMI Library or the FMU has to say from a warning on goes to the standard error. */
#include <fmilib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS = 40, BISECTIONS = 60, MOST_ROUNDS = 10, ROOM = 1000 };

#define DEMAND(condition)                                                                                             \
    if (!(condition)) exit((fprintf(stderr, "not so: %s\n", #condition), 4))

static fmi2_import_t *two; /* one of them */
static fmi3_import_t *three;
static size_t states, indicators;
static double next_event; /* infinite where there is none */

static void say(jm_callbacks *callbacks, jm_string module, jm_log_level_enu_t level, jm_string text) {
    (void)callbacks;
    fprintf(stderr, "%s, %s: %s\n", module, jm_log_level_to_string(level), text);
}

static void set(double time, const double *x) {
    DEMAND(two ? !fmi2_import_set_time(two, time) : !fmi3_import_set_time(three, time));
    DEMAND(two ? !fmi2_import_set_continuous_states(two, x, states) :
                 !fmi3_import_set_continuous_states(three, x, states));
}

static void rates(double time, const double *x, double *dx) {
    set(time, x);
    DEMAND(two ? !fmi2_import_get_derivatives(two, dx, states) :
                 !fmi3_import_get_derivatives(three, dx, states));
}

static void indicate(double *z) {
    if (!indicators) return;
    DEMAND(two ? !fmi2_import_get_event_indicators(two, z, indicators) :
                 !fmi3_import_get_event_indicators(three, z, indicators));
}

static void integrate(double time, double h, const double *x, double *end) {
    static double k[4][ROOM], y[ROOM];
    const double at[] = {0.5, 0.5, 1.0};
    rates(time, x, k[0]);
    for (int stage = 0; stage < 3; stage++) {
        for (size_t i = 0; i < states; i++) y[i] = x[i] + at[stage] * h * k[stage][i];
        rates(time + at[stage] * h, y, k[stage + 1]);
    }
    for (size_t i = 0; i < states; i++) end[i] = x[i] + h / 6.0 * (k[0][i] + 2.0 * (k[1][i] + k[2][i]) + k[3][i]);
    set(time + h, end);
}

static int crossed(const double *before) {
    static double z[ROOM];
    indicate(z);
    for (size_t i = 0; i < indicators; i++)
        if ((z[i] > 0.0) != (before[i] > 0.0)) return 1;
    return 0;
}

static void iterate(double *x) {
    int rounds = 0, more = 1;
    while (more && rounds++ < MOST_ROUNDS) {
        if (two) {
            fmi2_event_info_t info = {0};
            DEMAND(!fmi2_import_new_discrete_states(two, &info));
            DEMAND(!info.terminateSimulation);
            more = info.newDiscreteStatesNeeded;
            next_event = info.nextEventTimeDefined ? info.nextEventTime : INFINITY;
        } else {
            fmi3_boolean_t again, ended, nominals, values, defined;
            double next = 0.0;
            DEMAND(!fmi3_import_update_discrete_states(three, &again, &ended, &nominals, &values, &defined, &next));
            DEMAND(!ended);
            more = again;
            next_event = defined ? next : INFINITY;
        }
    }
    DEMAND(!more);
    DEMAND(two ? !fmi2_import_enter_continuous_time_mode(two) : !fmi3_import_enter_continuous_time_mode(three));
    DEMAND(two ? !fmi2_import_get_continuous_states(two, x, states) :
                 !fmi3_import_get_continuous_states(three, x, states));
}

static int completed(void) {
    if (two) {
        fmi2_boolean_t event, ended;
        DEMAND(!fmi2_import_completed_integrator_step(two, fmi2_true, &event, &ended) && !ended);
        return event;
    }
    fmi3_boolean_t event, ended;
    DEMAND(!fmi3_import_completed_integrator_step(three, fmi3_true, &event, &ended) && !ended);
    return event;
}

static void run(double step, int steps) {
    static double x[ROOM], y[ROOM], z[ROOM];
    double time = 0.0;
    iterate(x);
    indicate(z);
    for (int k = 1; k <= steps * PARTS; k++) {
        while (time < k * step / PARTS) {
            double end = fmin(k * step / PARTS, next_event);
            integrate(time, end - time, x, y);
            int event = crossed(z);
            if (event) {
                double before = time, middle;
                for (int n = 0; n < BISECTIONS && (middle = 0.5 * (before + end)) > before && middle < end; n++) {
                    integrate(time, middle - time, x, y);
                    *(crossed(z) ? &end : &before) = middle;
                }
                integrate(time, end - time, x, y);
            }
            time = end;
            memcpy(x, y, states * sizeof *x);
            if (completed() || event || time >= next_event) {
                DEMAND(two ? !fmi2_import_enter_event_mode(two) : !fmi3_import_enter_event_mode(three));
                iterate(x);
            }
            indicate(z);
        }
    }
}

static void run2(fmi_import_context_t *context, const char *folder, double step, int steps, char **names, int count) {
    DEMAND((two = fmi2_import_parse_xml(context, folder, NULL)));
    fmi2_callback_functions_t functions = {fmi2_log_forwarding, calloc, free, NULL, two};
    DEMAND(!fmi2_import_create_dllfmu(two, fmi2_fmu_kind_me, &functions));
    states = fmi2_import_get_number_of_continuous_states(two);
    indicators = fmi2_import_get_number_of_event_indicators(two);
    DEMAND(states <= ROOM && indicators <= ROOM);
    DEMAND(!fmi2_import_instantiate(two, "one", fmi2_model_exchange, NULL, fmi2_false));
    DEMAND(!fmi2_import_setup_experiment(two, fmi2_false, 0, 0, fmi2_false, 0));
    DEMAND(!fmi2_import_enter_initialization_mode(two));
    DEMAND(!fmi2_import_exit_initialization_mode(two));
    run(step, steps);
    for (int k = 0; k < count; k++) {
        fmi2_import_variable_t *variable = fmi2_import_get_variable_by_name(two, names[k]);
        DEMAND(variable);
        fmi2_value_reference_t reference = fmi2_import_get_variable_vr(variable);
        fmi2_real_t real;
        DEMAND(!fmi2_import_get_real(two, &reference, 1, &real));
        printf("%.17g\n", real);
    }
    DEMAND(!fmi2_import_terminate(two));
    fmi2_import_free_instance(two);
    fmi2_import_destroy_dllfmu(two);
    fmi2_import_free(two);
}

static void run3(fmi_import_context_t *context, const char *folder, double step, int steps, char **names, int count) {
    DEMAND((three = fmi3_import_parse_xml(context, folder, NULL)));
    DEMAND(!fmi3_import_create_dllfmu(three, fmi3_fmu_kind_me, NULL, NULL));
    DEMAND(!fmi3_import_instantiate_model_exchange(three, "one", NULL, fmi3_false, fmi3_false));
    DEMAND(!fmi3_import_get_number_of_continuous_states(three, &states));
    DEMAND(!fmi3_import_get_number_of_event_indicators(three, &indicators));
    DEMAND(states <= ROOM && indicators <= ROOM);
    DEMAND(!fmi3_import_enter_initialization_mode(three, fmi3_false, 0, 0, fmi3_false, 0));
    DEMAND(!fmi3_import_exit_initialization_mode(three));
    run(step, steps);
    for (int k = 0; k < count; k++) {
        fmi3_import_variable_t *variable = fmi3_import_get_variable_by_name(three, names[k]);
        DEMAND(variable);
        fmi3_value_reference_t reference = fmi3_import_get_variable_vr(variable);
        fmi3_float64_t real;
        DEMAND(!fmi3_import_get_float64(three, &reference, 1, &real, 1));
        printf("%.17g\n", real);
    }
    DEMAND(!fmi3_import_terminate(three));
    fmi3_import_free_instance(three);
    fmi3_import_destroy_dllfmu(three);
    fmi3_import_free(three);
}

int main(int argc, char **argv) {
    if (argc < 5) return fprintf(stderr, "Usage: fmi_library_exchange FMU EMPTY_FOLDER STEP STEPS NAME ...\n"), 2;
    jm_callbacks callbacks = {malloc, calloc, realloc, free, say, jm_log_level_warning, NULL, ""};
    fmi_import_context_t *context = fmi_import_allocate_context(&callbacks);
    fmi_version_enu_t version = fmi_import_get_fmi_version(context, argv[1], argv[2]);
    DEMAND(version == fmi_version_2_0_enu || version == fmi_version_3_0_enu);
    (version == fmi_version_2_0_enu ? run2 : run3)(context, argv[2], strtod(argv[3], NULL), atoi(argv[4]), argv + 5,
                                                   argc - 5);
    fmi_import_free_context(context);
    return 0;
}
