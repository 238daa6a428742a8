/* Values by their value references: inputs, outputs, parameters, calculated parameters, in this order. */
#include <math.h>
#include <stdio.h>

#include "exchange.h"

static const char *const TYPES[2][3] = {{"Real", "Integer", "Boolean"}, {"Float64", "Int32", "Boolean"}};
static const char *const CAUSALITIES[] = {"input", "output", "parameter", "calculatedParameter"};

static const char *type_name(const Instance *x, int type) { return TYPES[x->fmi == 3][type]; }

static int is_time(const Instance *x, unsigned vr) { return x->fmi == 3 && vr == TIME_REFERENCE; }

/* What a value reference stands for: scalars that are equally far apart. */
typedef struct {
    const char *name;
    const Variable *first;
    size_t place; /* of the first */
    int count, stride, clocked;
} Meant;

/* The meaning of a value reference that is not time's; `first` is null where it has none. */
static Meant meant(const Instance *x, unsigned vr) {
    if (vr >= 1 && vr <= model.variable_count) {
        const Variable *v = model.variables + (vr - 1);
        return (Meant){v->name, v, vr - 1, 1, 0, 0};
    }
    if (x->fmi == 3 && vr >= FIRST_AGAIN && vr - FIRST_AGAIN < model.again_count) {
        const Again *again = model.again + (vr - FIRST_AGAIN);
        return (Meant){again->name, model.variables + again->first, again->first, again->count, again->stride,
                       again->clocked};
    }
    return (Meant){0};
}

static Status check_reference(const Instance *x, int type, unsigned vr) {
    if ((is_time(x, vr) || is_exchanged(x, vr)) && type == REAL) return OK;
    Meant m = meant(x, vr);
    if (!m.first)
        return refuse(x, "There is no variable of type %s with value reference %u; references run from 1 to %u.",
                      type_name(x, type), vr, last_exchanged(x));
    if (m.first->type != type)
        return refuse(x, "%s (value reference %u) is of type %s, not %s.", m.name, vr, type_name(x, m.first->type),
                      type_name(x, type));
    if (m.clocked && x->head.phase != EVENT)
        return refuse(x, "fmi3Get%s: %s is clocked; read it in event mode, or read %s.", type_name(x, type), m.name,
                      m.first->name);
    return OK;
}

/* Elements of a variable: arrays exist in FMI 3.0 only. */
static size_t elements(const Instance *x, unsigned vr) {
    return is_time(x, vr) || is_exchanged(x, vr) ? 1 : (size_t)meant(x, vr).count;
}

/* Check references, and that the values given are as many as their elements. */
static Status check_references(const Instance *x, int type, const unsigned vr[], size_t count, const void *values,
                               size_t value_count) {
    if (count > 0 && (!vr || !values)) return refuse(x, "A pointer to value references or values is null.");
    size_t needed = 0;
    for (size_t k = 0; k < count; k++) {
        if (check_reference(x, type, vr[k]) != OK) return ERROR;
        needed += elements(x, vr[k]);
    }
    if (needed == value_count) return OK;
    return refuse(x, "The variables have %zu values together, and %zu were given.", needed, value_count);
}

/* The place of a scalar's value; outputs and calculated parameters must have been read. */
static double *place(const Instance *x, size_t scalar) {
    size_t first_parameter = model.inputs + model.outputs;
    if (scalar < model.inputs) return FIELD(x, inputs) + scalar;
    if (scalar < first_parameter) return FIELD(x, outputs) + (scalar - model.inputs);
    if (scalar < first_parameter + model.parameters) return x->parameters + (scalar - first_parameter);
    return FIELD(x, outputs) + (scalar - model.inputs - model.parameters);
}

/* The value of one element; at an impact those before it, but for what its clock's tick brings. */
static double element(const Instance *x, const Meant *m, size_t e) {
    size_t scalar = m->place + e * (size_t)m->stride;
    if (x->head.left && m->first->causality == OUTPUT && !m->clocked)
        return FIELD(x, left_outputs)[scalar - model.inputs];
    return *place(x, scalar);
}

static int is_set_from_outside(const Meant *m) {
    return m->first && m->first->causality != OUTPUT && m->first->causality != CALCULATED;
}

/* Bring the outputs up to date if one of the references needs it. */
static Status read_for(Instance *x, const unsigned vr[], size_t count) {
    if (x->outputs_read) return OK;
    size_t k = 0;
    for (; k < count; k++) {
        Meant m = meant(x, vr[k]);
        if (!is_set_from_outside(&m) && !is_time(x, vr[k])) break;
    }
    if (k == count) return OK;
    if (prepare(x) != OK) return ERROR;
    mechanism_read_outputs(x->block, (int64_t)model.words);
    x->outputs_read = 1;
    return OK;
}

static void put(void *values, size_t k, Form form, double value) {
    if (form == AS_DOUBLE) ((double *)values)[k] = value;
    if (form == AS_INT32) ((int32_t *)values)[k] = (int32_t)fmax(fmin(value, INT32_MAX), INT32_MIN);
    if (form == AS_BYTE) ((unsigned char *)values)[k] = value != 0;
}

static double take(const void *values, size_t k, Form form) {
    if (form == AS_DOUBLE) return ((const double *)values)[k];
    if (form == AS_INT32) return ((const int32_t *)values)[k];
    return ((const unsigned char *)values)[k];
}

Status get_values(Instance *x, int type, const unsigned vr[], size_t count, Form form, void *values,
                  size_t value_count) {
    if (check_references(x, type, vr, count, values, value_count) != OK || read_for(x, vr, count) != OK) return ERROR;
    size_t next = 0;
    for (size_t k = 0; k < count; k++) {
        if (is_time(x, vr[k])) {
            put(values, next++, form, time_of(x));
            continue;
        }
        if (is_exchanged(x, vr[k])) {
            put(values, next++, form, exchanged(x, vr[k]));
            continue;
        }
        Meant m = meant(x, vr[k]);
        for (size_t e = 0; e < (size_t)m.count; e++) {
            double value = element(x, &m, e);
            put(values, next++, form, type == BOOLEAN ? value != 0 : value);
        }
    }
    return OK;
}

static Status check_value(const Instance *x, const Variable *v, double value) {
    if (!isfinite(value))
        return refuse(x, "%s = %s is not a finite number; give a value in%s.", v->name,
                      isnan(value) ? "nan" : value > 0 ? "inf" : "-inf", *v->unit ? v->unit : " plain numbers");
    if (value < v->minimum)
        return refuse(x, "%s = %g%s is below its limit; give at least %g%s.", v->name, value, v->unit, v->minimum,
                      v->unit);
    if (value > v->maximum)
        return refuse(x, "%s = %g%s is above its limit; give at most %g%s.", v->name, value, v->unit, v->maximum,
                      v->unit);
    return OK;
}

static Status check_set(Instance *x, unsigned vr, double value) {
    if (is_time(x, vr)) return refuse(x, "time is the independent variable and cannot be set.");
    if (is_exchanged(x, vr))
        return refuse(x, "The variable with value reference %u is a state of Model Exchange, or follows from them; states "
                         "are set all at once, by fmi%dSetContinuousStates.", vr, x->fmi);
    Meant m = meant(x, vr);
    const Variable *v = m.first;
    if (!is_set_from_outside(&m))
        return refuse(x, "%s is of causality %s and cannot be set.", m.name, CAUSALITIES[v->causality]);
    unsigned allowed = IN(INSTANTIATED) | IN(INITIALIZATION);
    if (v->causality == INPUT) allowed |= IN(STEPPING) | IN(EVENT) | IN(CONTINUOUS);
    if (!(allowed & IN(x->head.phase))) {
        char call[300];
        snprintf(call, sizeof call, "Setting %s %s", CAUSALITIES[v->causality], v->name);
        allowed &= ~(x->exchange ? IN(STEPPING) : x->fmi == 3 ? IN(CONTINUOUS) : IN(CONTINUOUS) | IN(EVENT));
        return require(x, call, allowed);
    }
    return check_value(x, v, value);
}

/* Set all values, or none when one is refused. No variable that can be set is an array. */
Status set_values(Instance *x, int type, const unsigned vr[], size_t count, Form form, const void *values,
                  size_t value_count) {
    if (check_references(x, type, vr, count, values, value_count) != OK) return ERROR;
    for (size_t k = 0; k < count; k++)
        if (check_set(x, vr[k], take(values, k, form)) != OK) return ERROR;
    for (size_t k = 0; k < count; k++) {
        double value = take(values, k, form);
        *place(x, vr[k] - 1) = type == BOOLEAN ? value != 0 : value; /* hosts pass -1 and 255, too */
    }
    x->outputs_read = 0;
    if (x->head.phase == INSTANTIATED || x->head.phase == INITIALIZATION) x->head.prepared = 0;
    return OK;
}

static Status check_order(const Instance *x, int order) {
    if (order == 1) return OK;
    return refuse(x, "There is no derivative of order %d here, but only of order 1.", order);
}

Status set_slopes(Instance *x, const unsigned vr[], size_t count, const int order[], const double values[]) {
    if (count > 0 && (!vr || !order || !values))
        return refuse(x, "A pointer to value references, orders or values is null.");
    for (size_t k = 0; k < count; k++) {
        if (check_order(x, order[k]) != OK) return ERROR;
        if (vr[k] - 1 >= model.inputs) /* 0 wraps around */
            return refuse(x, "The variable with value reference %u is no input and has no derivative to set.", vr[k]);
        if (!isfinite(values[k]))
            return refuse(x, "The derivative of %s is not a finite number.", model.variables[vr[k] - 1].name);
    }
    for (size_t k = 0; k < count; k++) FIELD(x, input_slopes)[vr[k] - 1] = values[k];
    return OK;
}

Status get_rates(Instance *x, const unsigned vr[], size_t count, const int order[], double values[],
                 size_t value_count) {
    if (check_references(x, REAL, vr, count, values, value_count) != OK) return ERROR;
    if (count > 0 && !order) return refuse(x, "The pointer to the orders of the derivatives is null.");
    if (prepare(x) != OK) return ERROR;
    mechanism_read_output_rates(x->block, (int64_t)model.words);
    for (size_t k = 0; k < count; k++) {
        if (check_order(x, order[k]) != OK) return ERROR;
        if (is_time(x, vr[k]) || is_exchanged(x, vr[k]))
            return refuse(x, "%s is no output; there are derivatives of outputs only.",
                          is_time(x, vr[k]) ? "time" : "A state");
        Meant m = meant(x, vr[k]);
        if (m.first->causality != OUTPUT)
            return refuse(x, "%s is no output; there are derivatives of outputs only.", m.name);
        double rate = FIELD(x, output_rates)[m.place - model.inputs];
        if (isnan(rate) || x->head.left) {
            say(x, DISCARD, "logStatusDiscard", "%s: %s has no derivative with respect to time%s.", x->name, m.name,
                isnan(rate) ? "" : " at an impact, until fmi3UpdateDiscreteStates");
            return DISCARD;
        }
        values[k] = rate; /* no array gets here: they are all discrete */
    }
    return OK;
}
