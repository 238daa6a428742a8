/* A model as data, in place of model.c, for the one module of all pages; model_image.py writes it. */
#include <math.h>
#include <string.h>

#include "engine.h"
#include "model.h"

/* What model_image.py takes for granted: the data are laid out as the compiler for the browser lays out structures. */
_Static_assert(sizeof(void *) == 4 && sizeof(size_t) == 4 && _Alignof(double) == 8, "pointers, sizes and doubles");
_Static_assert(sizeof(Variable) == 48 && sizeof(Again) == 20 && sizeof(Finding) == 8 && sizeof(Word) == 8, "structures");
_Static_assert(sizeof(Joint) == 12 && sizeof(Rule) == 48 && sizeof(Contact) == 12 && sizeof(Model) == 148, "structures");

/* One operation of the formulas; a, b and c are places in `x`. The order is that of STEPS in model_image.py. */
enum { ADD, SUBTRACT, MULTIPLY, DIVIDE, NEGATE, SIN, COS, TAN, SQRT, ATAN2, WHERE_POSITIVE };

typedef struct {
    int what, a, b, c;
} Step;

typedef struct {
    double *x;    /* parameters, constants, and the result of each step */
    size_t first; /* of the results */
    const Step *steps;
    size_t step_count;
    const int *words; /* where in x: of each of `model.dependent` */
    const int *numbers;
    size_t number_count;
} Formulas;

/* Places are counted from the head, in bytes. */
typedef struct {
    uint32_t model, formulas;
    uint32_t pointers, pointer_count; /* where there is a place in the data that becomes a pointer */
} Head;

Model model;
static Formulas formulas;

/* Take a model, once, before anything else; the data stay where they are, at a multiple of 8. */
__attribute__((export_name("page_load"))) void page_load(unsigned char *data) {
    Head head;
    memcpy(&head, data, sizeof head);
    for (uint32_t k = 0; k < head.pointer_count; k++) {
        uint32_t where, place;
        memcpy(&where, data + head.pointers + k * sizeof where, sizeof where);
        memcpy(&place, data + where, sizeof place);
        place += (uint32_t)(uintptr_t)data;
        memcpy(data + where, &place, sizeof place);
    }
    memcpy(&model, data + head.model, sizeof model);
    memcpy(&formulas, data + head.formulas, sizeof formulas);
}

void mechanism_formulas(const double *p, double *block, double *findings) {
    double *x = formulas.x, *result = x + formulas.first;
    memcpy(x, p, model.parameters * sizeof *x);
    for (const Step *step = formulas.steps, *end = step + formulas.step_count; step < end; step++) {
        double a = x[step->a], b = x[step->b];
        switch (step->what) {
        case ADD: *result++ = a + b; break;
        case SUBTRACT: *result++ = a - b; break;
        case MULTIPLY: *result++ = a * b; break;
        case DIVIDE: *result++ = a / b; break;
        case NEGATE: *result++ = -a; break;
        case SIN: *result++ = mechanism_sin(a); break;
        case COS: *result++ = mechanism_cos(a); break;
        case TAN: *result++ = mechanism_tan(a); break;
        case SQRT: *result++ = sqrt(a); break;
        case ATAN2: *result++ = mechanism_atan2(a, b); break;
        case WHERE_POSITIVE: *result++ = a > 0.0 ? b : x[step->c]; break;
        }
    }
    for (size_t k = 0; k < model.dependent_count; k++) block[model.dependent[k].word] = x[formulas.words[k]];
    for (size_t k = 0; k < formulas.number_count; k++) findings[k] = x[formulas.numbers[k]];
}
