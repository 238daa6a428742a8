/* What a saved state is checked for. */
#ifndef SAVED_H
#define SAVED_H

#include "instance.h"

/* Refuse what cannot have been saved. Of a state that did not begin, only the inputs are kept. */
Status check_saved(Instance *x, const Head *head, const double *parameters, double *state);

#endif
