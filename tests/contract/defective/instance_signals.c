/* Programs whose instances declare signals that are not allowed. */
#include <gault/gault.h>
static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    (void)self, (void)step, (void)error;
    return GAULT_OK;
}
static const gault_signal depth = {.name = "depth", .unit = "m", .doc = "Depth."};
static const gault_program_signals* null_signals(const void* self) {
    (void)self;
    return NULL;
}
static const gault_program_signals* short_signals(const void* self) {
    static const gault_program_signals signals = {.size = 16};
    (void)self;
    return &signals;
}
static const gault_program_signals* listless_signals(const void* self) {
    static const gault_program_signals signals = {.size = sizeof signals, .measure_count = 2};
    (void)self;
    return &signals;
}
static const gault_program_signals* twice_signals(const void* self) {
    static gault_signal records[2];
    static const gault_program_signals signals = {
        .size = sizeof signals, .records = records, .record_count = 2};
    (void)self;
    records[0] = records[1] = depth;
    return &signals;
}
static const gault_program_signals* misnamed_signals(const void* self) {
    static const gault_signal control = {.name = "Wall speed", .unit = "m/s", .doc = "Speed."};
    static const gault_program_signals signals = {
        .size = sizeof signals, .controls = &control, .control_count = 1};
    (void)self;
    return &signals;
}
static const gault_program_signals* unitless_signals(const void* self) {
    static const gault_signal memory = {.name = "travel", .doc = "So far."};
    static const gault_program_signals signals = {
        .size = sizeof signals, .memories = &memory, .memory_count = 1};
    (void)self;
    return &signals;
}
#define COMPONENTS &null, &brief, &listless, &twice, &misnamed, &unitless, NULL
#define PROGRAM(word, signals_)                                                                              \
    static const gault_program_api word##_api = {                                                            \
        .size = sizeof word##_api, .advance = advance, .instance_signals = signals_};                        \
    static const gault_component word = {.size = sizeof word,                                                \
                                         .kind = GAULT_PROGRAM,                                              \
                                         .name = #word,                                                      \
                                         .version = "1.0.0",                                                 \
                                         .doc = "A program.",                                                \
                                         .reference = "",                                                    \
                                         .parameters = parameters,                                           \
                                         .api = &word##_api,                                                 \
                                         .create = create,                                                   \
                                         .destroy = destroy};
#define MORE                                                                                                 \
    PROGRAM(null, null_signals)                                                                              \
    PROGRAM(brief, short_signals)                                                                            \
    PROGRAM(listless, listless_signals)                                                                      \
    PROGRAM(twice, twice_signals)                                                                            \
    PROGRAM(misnamed, misnamed_signals)                                                                      \
    PROGRAM(unitless, unitless_signals)
#include "tiny.h"
