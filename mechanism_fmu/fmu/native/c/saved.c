/* Saved states: everything that a replay needs in one piece of memory, and as bytes that nothing else is taken for. */
#include <math.h>
#include <string.h>

#include "instance.h"
#include "saved.h"

static const char MAGIC[] = {'M', 'e', 'c', 'h', 'F', 'M', 'U', 'n'};

/* Parameters and the engine's state follow. */
struct Saved {
    Head head;
    double words[];
};

static size_t first_of_state(void) { return (size_t)((const int64_t *)model.block)[SLOT_FIRST_OF_STATE]; }

static size_t state_words(void) {
    return (size_t)((const int64_t *)model.block)[SLOT_END_OF_STATE] - first_of_state();
}

static size_t saved_size(void) { return sizeof(Saved) + (model.parameters + state_words()) * sizeof(double); }

Status save(Instance *x, Saved **state) {
    if (!*state) *state = x->allocate(1, saved_size());
    if (!*state) return refuse(x, "There is no memory for a saved state of %zu bytes.", saved_size());
    (*state)->head = x->head;
    memcpy((*state)->words, x->parameters, model.parameters * sizeof(double));
    memcpy((*state)->words + model.parameters, x->block + first_of_state(), state_words() * sizeof(double));
    return OK;
}

Status restore(Instance *x, const Saved *state) {
    if (!state) return refuse(x, "There is no state to restore: the pointer is null.");
    if (state->head.exchange != x->exchange)
        return refuse(x, "The state was saved by an instance for %s, and this one is not.",
                      x->exchange ? "co-simulation" : "Model Exchange");
    if (state->head.phase == EVENT && !x->event_mode && !x->exchange)
        return refuse(x, "The state was saved in event mode, and this instance was made without it.");
    x->head = state->head;
    memcpy(x->parameters, state->words, model.parameters * sizeof(double));
    memcpy(x->block + first_of_state(), state->words + model.parameters, state_words() * sizeof(double));
    if (x->head.left && !x->event_mode) { /* nobody would ever ask for what comes after the impact */
        memset(FIELD(x, left_outputs), 0, model.outputs * sizeof(double));
        x->head.left = 0;
    }
    if (x->head.prepared) write_tables(x);
    x->outputs_read = 0;
    forget_news(x);
    return OK;
}

void free_saved(Instance *x, Saved *state) {
    if (state) x->release(state);
}

/* As bytes: magic, the model's mark, length of the state, the state, and a checksum of all before it. */
enum { HEAD_SIZE = sizeof MAGIC + 16 + 8, CHECKSUM_SIZE = 4 };

size_t serialized_size(void) { return HEAD_SIZE + saved_size() + CHECKSUM_SIZE; }

/* CRC-32 (ISO 3309), four bits at a time. */
static uint32_t checksum(const unsigned char *bytes, size_t count) {
    static const uint32_t table[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
                                       0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                       0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    uint32_t crc = 0xffffffff;
    for (size_t k = 0; k < count; k++) {
        crc = table[(crc ^ bytes[k]) & 15] ^ (crc >> 4);
        crc = table[(crc ^ (bytes[k] >> 4)) & 15] ^ (crc >> 4);
    }
    return ~crc;
}

Status serialize(Instance *x, const Saved *state, unsigned char *bytes, size_t size) {
    if (!state) return refuse(x, "There is no state to serialize: the pointer is null.");
    if (!bytes || size < serialized_size())
        return refuse(x, "The buffer of %zu bytes is too small for a saved state of %zu bytes.", size, serialized_size());
    uint64_t length = saved_size();
    memcpy(bytes, MAGIC, sizeof MAGIC);
    memcpy(bytes + sizeof MAGIC, model.mark, 16);
    memcpy(bytes + sizeof MAGIC + 16, &length, 8);
    memcpy(bytes + HEAD_SIZE, state, saved_size());
    uint32_t sum = checksum(bytes, HEAD_SIZE + saved_size());
    memcpy(bytes + HEAD_SIZE + saved_size(), &sum, CHECKSUM_SIZE);
    return OK;
}

Status deserialize(Instance *x, const unsigned char *bytes, size_t size, Saved **state) {
    uint64_t length;
    uint32_t sum;
    if (!bytes || size < HEAD_SIZE || memcmp(bytes, MAGIC, sizeof MAGIC) != 0)
        return refuse(x,
                      "The %zu bytes given are not a saved state of this kind of FMU; give what serializing a state "
                      "wrote.",
                      size);
    memcpy(&length, bytes + sizeof MAGIC + 16, 8);
    if (length > size || size != HEAD_SIZE + length + CHECKSUM_SIZE)
        return refuse(x, "The saved state has %zu bytes instead of %zu: it was cut off or extended.", size,
                      (size_t)length + HEAD_SIZE + CHECKSUM_SIZE);
    memcpy(&sum, bytes + size - CHECKSUM_SIZE, CHECKSUM_SIZE);
    if (checksum(bytes, size - CHECKSUM_SIZE) != sum)
        return refuse(x, "The saved state was changed after it was written: its checksum does not fit.");
    if (memcmp(bytes + sizeof MAGIC, model.mark, 16) != 0 || length != saved_size())
        return refuse(x, "The saved state belongs to another model or another version of this one.");
    *state = x->allocate(1, saved_size());
    if (!*state) return refuse(x, "There is no memory for a saved state of %zu bytes.", saved_size());
    memcpy(*state, bytes + HEAD_SIZE, saved_size());
    double *words = (*state)->words;
    if (check_saved(x, &(*state)->head, words, words + model.parameters) == OK) return OK;
    x->release(*state);
    *state = NULL;
    return ERROR;
}
