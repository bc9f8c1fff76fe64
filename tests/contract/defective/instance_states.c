/* Materials whose instances declare states that are not allowed. */
#include <gault/gault.h>
#include <math.h>
static const gault_state good = {.name = "age", .unit = "s", .doc = "Age.", .shape = GAULT_SCALAR};
static const gault_state* null_states(const void* self, uint32_t* count) {
    (void)self;
    *count = 3;
    return NULL;
}
static const gault_state* shapeless_states(const void* self, uint32_t* count) {
    static const gault_state state = {.name = "age", .unit = "s", .doc = "Age.", .shape = (gault_shape)2};
    (void)self;
    *count = 1;
    return &state;
}
static const gault_state* twice_states(const void* self, uint32_t* count) {
    static gault_state states[2];
    (void)self;
    states[0] = states[1] = good;
    *count = 2;
    return states;
}
static const gault_state* nameless_states(const void* self, uint32_t* count) {
    static const gault_state state = {.unit = "s", .doc = "Age.", .shape = GAULT_SCALAR};
    (void)self;
    *count = 1;
    return &state;
}
static const gault_state* countless_states(const void* self, uint32_t* count) {
    static char names[5000][8];
    static gault_state states[5000];
    (void)self;
    for (int i = 0; i < 5000; ++i) {
        const char name[] = {'a', (char)('0' + i / 1000), (char)('0' + i / 100 % 10),
                             (char)('0' + i / 10 % 10), (char)('0' + i % 10), 0};
        for (int k = 0; k < 6; ++k)
            names[i][k] = name[k];
        states[i] = good;
        states[i].name = names[i];
    }
    *count = 5000;
    return states;
}
#define COMPONENTS &null, &shapeless, &twice, &nameless, &countless, NULL
#define SOIL(word)                                                                                           \
    static const gault_material_api word##_api = {                                                           \
        .size = sizeof word##_api, .update = update, .instance_states = word##_states};                      \
    static const gault_component word = {.size = sizeof word,                                                \
                                         .kind = GAULT_MATERIAL,                                             \
                                         .name = #word,                                                      \
                                         .version = "1.0.0",                                                 \
                                         .doc = "A soil.",                                                   \
                                         .reference = "",                                                    \
                                         .parameters = parameters,                                           \
                                         .api = &word##_api,                                                 \
                                         .create = create,                                                   \
                                         .destroy = destroy};
#define MORE SOIL(null) SOIL(shapeless) SOIL(twice) SOIL(nameless) SOIL(countless)
#include "tiny.h"
