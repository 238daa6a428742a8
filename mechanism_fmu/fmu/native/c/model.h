/* A model as constants: written by the build (model_source.py), the same for both versions of FMI; or, for pages, as data
   (model_image.py). */
#ifndef MODEL_H
#define MODEL_H

#include <stddef.h>
#include <stdint.h>

enum Type { REAL, INTEGER, BOOLEAN };
enum Causality { INPUT, OUTPUT, PARAMETER, CALCULATED };

/* A scalar; its value reference is its place in the array, from 1. In FMI 3.0, time follows behind them. */
typedef struct {
    const char *name;
    const char *unit; /* as messages show it: with a space before it, "" of plain numbers */
    int type, causality;
    int continuous;
    double start, minimum, maximum; /* minimum and maximum are infinite where there is no limit */
} Variable;

/* FMI 3.0 with a clock: outputs once more, behind the clock, which stands behind time. */
typedef struct {
    const char *name;
    size_t first;      /* place of the scalar that it begins with */
    int count, stride; /* elements, and how many scalars they lie apart */
    int clocked;       /* value of the present tick, to be read in event mode */
} Again;

/* What is wrong, or odd, with parameter values: `at` says where in the findings its condition and numbers stand. */
typedef struct {
    const char *text;
    int at;
} Finding;

/* A table word that depends on parameters. */
typedef struct {
    size_t word;
    const char *label;
} Word;

typedef struct {
    const char *name;
    int rows;
    const char *unit; /* of the motion, where it is a driver */
} Joint;

/* What words of the state may hold: `rows` times `columns` of them, `stride` words from row to row. */
typedef struct {
    const char *name;
    size_t first; /* in the state */
    size_t rows, columns, stride;
    int integer, whole, nan; /* stored as int64; whole numbers only; NaN is allowed */
    double low, high;
} Rule;

typedef struct {
    const char *name, *before, *behind; /* the depth by which it starts inside the other body */
} Contact;

typedef struct {
    const char *name, *guid;         /* the GUID of FMI 2.0 is the instantiation token of FMI 3.0 */
    unsigned char mark[16];          /* what a serialized state is recognised by */
    const Variable *variables;
    size_t variable_count, inputs, outputs, parameters; /* in this order; calculated parameters follow */
    int has_clock;
    const Again *again;
    size_t again_count;
    const double *block;                                /* of an instance before its first call */
    size_t given, words;                                /* without and with work, which is 0 */
    size_t numbers; /* of all findings */
    const Finding *objections, *problems, *warnings; /* problems: of the mechanism, where nothing is objected to */
    size_t objection_count, problem_count, warning_count;
    const Word *dependent; /* on parameters */
    size_t dependent_count;
    const char *const *bodies;
    const Joint *joints;
    const Contact *contacts;
    const char *const *patterns;
    const char *const *functions;
    const char *const *rubs;
    const char *const *elements;
    const char *const *unknowns; /* of the engine, as messages name them */
    const Rule *rules;           /* what the words of the state may hold */
    size_t rule_count;
    const double *nominals; /* of the continuous states of Model Exchange */
} Model;

#ifdef MODEL_IS_LOADED
extern Model model; /* before anything else is called: loaded.c */
#else
extern const Model model;
#endif

/* Parameters to tables: p of `model.parameters` values; writes words of the block, and `model.numbers` of findings. */
void mechanism_formulas(const double *p, double *block, double *findings);

#endif
