/* Components of plugins that were built for other minors of this ABI: apis as short as 1.0 had them, for ever, and
 * apis with a field that this host does not know. */
#include <gault/gault.h>

enum { MATERIAL_1_0 = 56, BOUNDARY_1_0 = 40, PROGRAM_1_0 = 40, OBSERVER_1_0 = 48 };

static gault_status create(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    (void)host, (void)values, (void)self, (void)error;
    return GAULT_OK;
}
static void destroy(void* self) {
    (void)self;
}
static gault_status update(const void* self, gault_points* points, gault_error* error) {
    (void)self, (void)points, (void)error;
    return GAULT_OK;
}
static gault_status load(const void* self, gault_facets* facets, gault_error* error) {
    (void)self, (void)facets, (void)error;
    return GAULT_OK;
}
static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    (void)self, (void)step, (void)error;
    return GAULT_OK;
}
static gault_status evaluate(const void* self, gault_sample* sample, gault_error* error) {
    (void)self, (void)sample, (void)error;
    return GAULT_OK;
}

static const gault_program_signals none = {.size = sizeof none};
static const gault_material_api first_material = {.size = MATERIAL_1_0, .update = update};
static const gault_boundary_api first_boundary = {.size = BOUNDARY_1_0, .load = load};
static const gault_program_api first_program = {.size = PROGRAM_1_0, .signals = &none, .advance = advance};
static const gault_observer_api first_observer = {.size = OBSERVER_1_0, .evaluate = evaluate};

static const struct {
    gault_material_api known;
    void (*later)(void);
} later_material = {{.size = sizeof later_material, .update = update}, NULL};
static const struct {
    gault_program_api known;
    void (*later)(void);
} later_program = {{.size = sizeof later_program, .signals = &none, .advance = advance}, NULL};

static const gault_parameter* const parameters[] = {NULL};

#define COMPONENT(component_kind, component_name)                                                            \
    static const gault_component component_name##_component = {.size = sizeof(gault_component),              \
                                                               .kind = component_kind,                       \
                                                               .name = #component_name,                      \
                                                               .version = "1.0.0",                           \
                                                               .doc = "Does nothing.",                       \
                                                               .reference = "",                              \
                                                               .parameters = parameters,                     \
                                                               .api = &component_name,                       \
                                                               .create = create,                             \
                                                               .destroy = destroy}
COMPONENT(GAULT_MATERIAL, first_material);
COMPONENT(GAULT_BOUNDARY, first_boundary);
COMPONENT(GAULT_PROGRAM, first_program);
COMPONENT(GAULT_OBSERVER, first_observer);
COMPONENT(GAULT_MATERIAL, later_material);
COMPONENT(GAULT_PROGRAM, later_program);

static const gault_component* const components[] = {&first_material_component,
                                                    &first_boundary_component,
                                                    &first_program_component,
                                                    &first_observer_component,
                                                    &later_material_component,
                                                    &later_program_component,
                                                    NULL};

GAULT_EXPORT const gault_module GAULT_ENTRY = {.magic = GAULT_MAGIC,
                                               .abi_major = GAULT_ABI_MAJOR,
                                               .abi_minor = GAULT_ABI_MINOR,
                                               .size = sizeof(gault_module),
                                               .needs_minor = 0,
                                               .pointer_bytes = sizeof(void*),
                                               .real_bytes = sizeof(double),
                                               .name = "other_minors",
                                               .version = "1.0.0",
                                               .author = "The Gault authors",
                                               .license = "MIT",
                                               .built_with = __VERSION__,
                                               .components = components};
