/* One FMU in FMI Library: equal steps, and the values of some variables at the end, each on a line.

   Usage: fmi_library FMU EMPTY_FOLDER STEP STEPS EVENT_MODE NAME ...

   Whatever FMI Library or the FMU has to say from a warning on goes to the standard error. */
#include <fmilib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEMAND(condition)                                                                                             \
    if (!(condition)) return fprintf(stderr, "not so: %s\n", #condition), 4

static void say(jm_callbacks *callbacks, jm_string module, jm_log_level_enu_t level, jm_string text) {
    (void)callbacks;
    fprintf(stderr, "%s, %s: %s\n", module, jm_log_level_to_string(level), text);
}

static int run2(fmi_import_context_t *context, const char *folder, double step, int steps, char **names, int count) {
    fmi2_import_t *fmu = fmi2_import_parse_xml(context, folder, NULL);
    DEMAND(fmu);
    fmi2_callback_functions_t functions = {fmi2_log_forwarding, calloc, free, NULL, fmu};
    DEMAND(!fmi2_import_create_dllfmu(fmu, fmi2_fmu_kind_cs, &functions));
    DEMAND(!fmi2_import_instantiate(fmu, "one", fmi2_cosimulation, NULL, fmi2_false));
    DEMAND(!fmi2_import_setup_experiment(fmu, fmi2_false, 0, 0, fmi2_false, 0));
    DEMAND(!fmi2_import_enter_initialization_mode(fmu));
    DEMAND(!fmi2_import_exit_initialization_mode(fmu));
    for (int k = 0; k < steps; k++) DEMAND(!fmi2_import_do_step(fmu, k * step, step, fmi2_true));
    for (int k = 0; k < count; k++) {
        fmi2_import_variable_t *variable = fmi2_import_get_variable_by_name(fmu, names[k]);
        DEMAND(variable);
        fmi2_base_type_enu_t type = fmi2_import_get_variable_base_type(variable);
        fmi2_value_reference_t reference = fmi2_import_get_variable_vr(variable);
        fmi2_real_t real = 0;
        fmi2_integer_t whole = 0;
        fmi2_boolean_t truth = 0;
        if (type == fmi2_base_type_real) DEMAND(!fmi2_import_get_real(fmu, &reference, 1, &real));
        if (type == fmi2_base_type_int) DEMAND(!fmi2_import_get_integer(fmu, &reference, 1, &whole));
        if (type == fmi2_base_type_bool) DEMAND(!fmi2_import_get_boolean(fmu, &reference, 1, &truth));
        printf("%.17g\n", real + whole + truth);
    }
    DEMAND(!fmi2_import_terminate(fmu));
    fmi2_import_free_instance(fmu);
    fmi2_import_destroy_dllfmu(fmu);
    fmi2_import_free(fmu);
    return 0;
}

static int handle_event(fmi3_import_t *fmu, int enter) {
    fmi3_boolean_t more = fmi3_true, told[4];
    double next;
    if (enter) DEMAND(!fmi3_import_enter_event_mode(fmu));
    while (more) DEMAND(!fmi3_import_update_discrete_states(fmu, &more, told, told + 1, told + 2, told + 3, &next));
    DEMAND(!fmi3_import_enter_step_mode(fmu));
    return 0;
}

static int run3(fmi_import_context_t *context, const char *folder, double step, int steps, int events, char **names,
                int count) {
    fmi3_import_t *fmu = fmi3_import_parse_xml(context, folder, NULL);
    DEMAND(fmu);
    fmi3_boolean_t event_mode = events != 0, event, ended, early;
    DEMAND(!fmi3_import_create_dllfmu(fmu, fmi3_fmu_kind_cs, NULL, NULL));
    DEMAND(!fmi3_import_instantiate_co_simulation(fmu, "one", NULL, fmi3_false, fmi3_false, event_mode, event_mode,
                                                  NULL, 0, NULL));
    DEMAND(!fmi3_import_enter_initialization_mode(fmu, fmi3_false, 0, 0, fmi3_false, 0));
    DEMAND(!fmi3_import_exit_initialization_mode(fmu));
    if (events) DEMAND(!handle_event(fmu, 0));
    for (int k = 0; k < steps; k++) {
        double time = k * step, end = (k + 1) * step;
        while (time < end) {
            DEMAND(!fmi3_import_do_step(fmu, time, end - time, fmi3_true, &event, &ended, &early, &time));
            DEMAND(!ended && (events || (!event && !early)));
            if (event) DEMAND(!handle_event(fmu, 1));
        }
    }
    for (int k = 0; k < count; k++) {
        fmi3_import_variable_t *variable = fmi3_import_get_variable_by_name(fmu, names[k]);
        DEMAND(variable);
        fmi3_base_type_enu_t type = fmi3_import_get_variable_base_type(variable);
        fmi3_value_reference_t reference = fmi3_import_get_variable_vr(variable);
        fmi3_float64_t real = 0;
        fmi3_int32_t whole = 0;
        fmi3_boolean_t truth = 0;
        if (type == fmi3_base_type_float64) DEMAND(!fmi3_import_get_float64(fmu, &reference, 1, &real, 1));
        if (type == fmi3_base_type_int32) DEMAND(!fmi3_import_get_int32(fmu, &reference, 1, &whole, 1));
        if (type == fmi3_base_type_bool) DEMAND(!fmi3_import_get_boolean(fmu, &reference, 1, &truth, 1));
        printf("%.17g\n", real + whole + truth);
    }
    DEMAND(!fmi3_import_terminate(fmu));
    fmi3_import_free_instance(fmu);
    fmi3_import_destroy_dllfmu(fmu);
    fmi3_import_free(fmu);
    return 0;
}

int main(int argc, char **argv) {
    if (argc < 6) return fprintf(stderr, "Usage: fmi_library FMU EMPTY_FOLDER STEP STEPS EVENT_MODE NAME ...\n"), 2;
    jm_callbacks callbacks = {malloc, calloc, realloc, free, say, jm_log_level_warning, NULL, ""};
    fmi_import_context_t *context = fmi_import_allocate_context(&callbacks);
    fmi_version_enu_t version = fmi_import_get_fmi_version(context, argv[1], argv[2]);
    double step = strtod(argv[3], NULL);
    int steps = atoi(argv[4]), events = atoi(argv[5]), status = 4;
    if (version == fmi_version_2_0_enu) status = run2(context, argv[2], step, steps, argv + 6, argc - 6);
    if (version == fmi_version_3_0_enu) status = run3(context, argv[2], step, steps, events, argv + 6, argc - 6);
    fmi_import_free_context(context);
    return status;
}
