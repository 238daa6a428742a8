/* A foreign FMU of FMI 3.0: each input of each type comes out again. Value reference k is an input, k + 100 its output.
 *
 * 1 Float32, 2 Float64[2], 3 Int8, 4 UInt8, 5 Int16, 6 UInt16, 7 Int32[3], 8 UInt32, 9 Int64, 10 UInt64, 11 Enumeration,
 * 12 Boolean[2], 13 String, 14 Binary. No event mode, no clock; functions that it has no use for are added by build.py. */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { OK = 0, ERROR = 3, ROOM = 1000 };

typedef struct {
    float single;
    double doubles[2];
    int8_t int8;
    uint8_t uint8;
    int16_t int16;
    uint16_t uint16;
    int32_t int32[3];
    uint32_t uint32;
    int64_t int64, enumeration;
    uint64_t uint64;
    bool booleans[2];
    char string[ROOM];
    uint8_t binary[ROOM];
    size_t size;
    double time;
} All;

const char *fmi3GetVersion(void) { return "3.0"; }

int fmi3Reset(All *a) {
    memset(a, 0, sizeof *a);
    a->single = 0.1f;
    a->doubles[1] = 2.5;
    a->uint64 = UINT64_MAX;
    a->enumeration = 1;
    strcpy(a->string, "two words");
    memcpy(a->binary, "\x00\xff", a->size = 2);
    return OK;
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                  bool event_mode, bool early, const uint32_t *required, size_t count, void *environment,
                                  void *log, void *update) {
    All *a = event_mode ? NULL : malloc(sizeof *a);
    if (a) fmi3Reset(a);
    return a;
}

void fmi3FreeInstance(All *a) { free(a); }

int fmi3EnterInitializationMode(All *a, bool tolerance_defined, double tolerance, double start, bool stop_defined,
                                double stop) {
    a->time = start;
    return OK;
}

int fmi3ExitInitializationMode(All *a) { return OK; }
int fmi3Terminate(All *a) { return OK; }

int fmi3DoStep(All *a, double now, double size, bool no_way_back, bool *event, bool *ends, bool *early, double *reached) {
    *event = *ends = *early = false;
    *reached = a->time = now + size;
    return OK;
}

static void *of(All *a, uint32_t reference) {
    switch (reference % 100) {
    case 1: return &a->single;
    case 2: return a->doubles;
    case 3: return &a->int8;
    case 4: return &a->uint8;
    case 5: return &a->int16;
    case 6: return &a->uint16;
    case 7: return a->int32;
    case 8: return &a->uint32;
    case 9: return &a->int64;
    case 10: return &a->uint64;
    case 11: return &a->enumeration;
    case 12: return a->booleans;
    default: return NULL;
    }
}

/* Whoever counts the values wrongly is refused. */
#define NUMBERS(Name, type, length, first, last)                                                               \
    int fmi3Get##Name(All *a, const uint32_t *vr, size_t n, type *values, size_t count) {                       \
        if (count != n * length) return ERROR;                                                                  \
        for (size_t k = 0; k < n; k++) {                                                                        \
            if (vr[k] % 100 < first || vr[k] % 100 > last) return ERROR;                                        \
            memcpy(values + k * length, of(a, vr[k]), length * sizeof(type));                                   \
        }                                                                                                       \
        return OK;                                                                                              \
    }                                                                                                           \
    int fmi3Set##Name(All *a, const uint32_t *vr, size_t n, const type *values, size_t count) {                 \
        if (count != n * length) return ERROR;                                                                  \
        for (size_t k = 0; k < n; k++) {                                                                        \
            if (vr[k] < first || vr[k] > last) return ERROR;                                                    \
            memcpy(of(a, vr[k]), values + k * length, length * sizeof(type));                                   \
        }                                                                                                       \
        return OK;                                                                                              \
    }

NUMBERS(Float32, float, 1, 1, 1)
NUMBERS(Float64, double, 2, 2, 2)
NUMBERS(Int8, int8_t, 1, 3, 3)
NUMBERS(UInt8, uint8_t, 1, 4, 4)
NUMBERS(Int16, int16_t, 1, 5, 5)
NUMBERS(UInt16, uint16_t, 1, 6, 6)
NUMBERS(Int32, int32_t, 3, 7, 7)
NUMBERS(UInt32, uint32_t, 1, 8, 8)
NUMBERS(UInt64, uint64_t, 1, 10, 10)
NUMBERS(Boolean, bool, 2, 12, 12)

int fmi3GetInt64(All *a, const uint32_t *vr, size_t n, int64_t *values, size_t count) {
    for (size_t k = 0; k < n; k++) values[k] = *(int64_t *)of(a, vr[k]);
    return OK;
}

int fmi3SetInt64(All *a, const uint32_t *vr, size_t n, const int64_t *values, size_t count) {
    for (size_t k = 0; k < n; k++) *(int64_t *)of(a, vr[k]) = values[k];
    return OK;
}

int fmi3GetString(All *a, const uint32_t *vr, size_t n, const char **values, size_t count) {
    for (size_t k = 0; k < n; k++) values[k] = a->string;
    return OK;
}

int fmi3SetString(All *a, const uint32_t *vr, size_t n, const char *const *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (strlen(values[k]) >= ROOM) return ERROR;
        strcpy(a->string, values[k]);
    }
    return OK;
}

int fmi3GetBinary(All *a, const uint32_t *vr, size_t n, size_t *sizes, const uint8_t **values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        sizes[k] = a->size;
        values[k] = a->binary;
    }
    return OK;
}

int fmi3SetBinary(All *a, const uint32_t *vr, size_t n, const size_t *sizes, const uint8_t *const *values, size_t count) {
    for (size_t k = 0; k < n; k++) {
        if (sizes[k] > ROOM) return ERROR;
        memcpy(a->binary, values[k], a->size = sizes[k]);
    }
    return OK;
}
