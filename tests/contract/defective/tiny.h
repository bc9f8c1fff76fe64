/* A small right plugin, one soil with one parameter. A defective plugin defines one of the macros below,
 * which adds initialisers to one of its declarations, and includes this file: a later initialiser wins over
 * an earlier one. */
#include <gault/gault.h>
#include <math.h>
#include <string.h>

#ifndef STATE
#define STATE .shape = GAULT_SCALAR
#endif
#ifndef PARAMETER
#define PARAMETER .flags = GAULT_REQUIRED
#endif
#ifndef API
#define API .flags = 0
#endif
#ifndef COMPONENT
#define COMPONENT .extension = NULL
#endif
#ifndef NAME
#define NAME "tiny"
#endif
#ifndef MODULE
#define MODULE .reserved = 0
#endif
#ifndef PARAMETERS
#define PARAMETERS &stiffness, NULL
#endif
#ifndef MORE
#define MORE
#endif
#ifndef COMPONENTS
#define COMPONENTS &soil, NULL
#endif

static gault_status create(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    (void)host, (void)values, (void)self, (void)error;
    return GAULT_OK;
}

static void destroy(void* self) {
    (void)self;
}

static gault_status update(const void* self, gault_points* points, gault_error* error) {
    (void)self, (void)error;
    for (int i = 0; i < 6; ++i)
        memcpy(points->stress[i], points->stress_old[i], (size_t)points->padded * sizeof(double));
    return GAULT_OK;
}

static const gault_parameter stiffness = {.size = sizeof(gault_parameter),
                                          .type = GAULT_REAL,
                                          .flags = GAULT_REQUIRED,
                                          .name = "stiffness",
                                          .symbol = "k",
                                          .unit = "Pa",
                                          .doc = "Stiffness.",
                                          .min = -HUGE_VAL,
                                          .max = HUGE_VAL,
                                          PARAMETER};
static const gault_parameter* const parameters[] = {PARAMETERS};

static const gault_state states[] = {
    {.name = "age", .unit = "s", .doc = "Age.", .shape = GAULT_SCALAR, .min = 0.0, .max = HUGE_VAL, STATE}};

static const gault_material_api api = {
    .size = sizeof(gault_material_api), .states = states, .state_count = 1, .update = update, API};

__attribute__((unused)) static const gault_component soil = {.size = sizeof(gault_component),
                                     .kind = GAULT_MATERIAL,
                                     .name = NAME,
                                     .version = "1.0.0",
                                     .doc = "A tiny soil.",
                                     .reference = "",
                                     .parameters = parameters,
                                     .api = &api,
                                     .create = create,
                                     .destroy = destroy,
                                     COMPONENT};
MORE
static const gault_component* const components[] = {COMPONENTS};

#ifndef ENTRY
#define ENTRY GAULT_ENTRY
#endif
GAULT_EXPORT const gault_module ENTRY = {.magic = GAULT_MAGIC,
                                         .abi_major = GAULT_ABI_MAJOR,
                                         .abi_minor = GAULT_ABI_MINOR,
                                         .size = sizeof(gault_module),
                                         .pointer_bytes = sizeof(void*),
                                         .real_bytes = sizeof(double),
                                         .name = "tiny",
                                         .version = "1.0.0",
                                         .author = "Nobody",
                                         .license = "MIT",
                                         .built_with = __VERSION__,
                                         .components = components,
                                         MODULE};
