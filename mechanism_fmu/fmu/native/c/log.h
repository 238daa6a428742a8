/* Log messages of an instance to the host: refusals, and what has happened since the last of them. */
#ifndef LOG_H
#define LOG_H

#include "instance_data.h"

OWN_FRAME void say(const Instance *x, Status status, const char *category, const char *format, ...);
OWN_FRAME Status refuse(const Instance *x, const char *format, ...); /* says why, and returns ERROR */
OWN_FRAME Status give_up(const Instance *x, const char *format, ...); /* of a step: the same with DISCARD */
Status set_logging(Instance *x, int on, size_t count, const char *const categories[]);

void log_news(Instance *x);
void forget_news(Instance *x); /* all that has happened so far counts as logged */
const char *advice_details(Instance *x, int64_t outcome, char *text, size_t size);

#endif
