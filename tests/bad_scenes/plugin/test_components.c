/* Components that do nothing and, between them, declare a parameter of every type. */
#include <gault/gault.h>
#include <math.h>
#include <string.h>

#define PARAMETER(...)                                                                                       \
    { .size = sizeof(gault_parameter), .symbol = "", __VA_ARGS__ }

static int instance; /* what every `self` points to */

static gault_status create(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    (void)host, (void)values, (void)error;
    *self = &instance;
    return GAULT_OK;
}
static void destroy(void* self) {
    (void)self;
}

/* ---- material ---- */

static const gault_parameter stiffness =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED | GAULT_MIN_OPEN, .name = "stiffness", .unit = "Pa",
              .doc = "Young's modulus.", .min = 0, .max = HUGE_VAL);
static const gault_parameter ratio =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_MIN_OPEN | GAULT_MAX_OPEN, .name = "ratio", .unit = "1",
              .doc = "Poisson's ratio.", .fallback = 0.25, .min = -1, .max = 0.5);
static const gault_parameter angle =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_MAX_OPEN, .name = "angle", .unit = "rad",
              .doc = "An angle below a right one.", .min = 0, .max = 1.5707963267948966);
static const gault_parameter limit =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_OPTIONAL, .name = "limit", .unit = "Pa",
              .doc = "A stress that is not exceeded.", .min = 0, .max = HUGE_VAL);
static const gault_parameter count = PARAMETER(.type = GAULT_INTEGER, .name = "count", .unit = "1",
                                               .doc = "How many.", .fallback = 3, .min = 1, .max = 10);
static const gault_parameter drained = PARAMETER(.type = GAULT_BOOLEAN, .name = "drained", .unit = "1",
                                                 .doc = "Whether water leaves.", .fallback = 1);
static const char* const shapes[] = {"round", "square", NULL};
static const gault_parameter shape =
    PARAMETER(.type = GAULT_CHOICE, .name = "shape", .unit = "1", .doc = "Of the section.", .choices = shapes,
              .fallback = 1, .min = 0, .max = 1);
static const gault_parameter label = PARAMETER(.type = GAULT_TEXT_VALUE, .flags = GAULT_OPTIONAL,
                                               .name = "label", .unit = "1", .doc = "Free text.");
static const gault_parameter properties =
    PARAMETER(.type = GAULT_LIST, .flags = GAULT_OPTIONAL, .name = "properties", .unit = "Pa",
              .doc = "Stresses.", .min = 0, .max = HUGE_VAL, .min_count = 2, .max_count = 3);
static const gault_parameter curve =
    PARAMETER(.type = GAULT_TABLE, .flags = GAULT_OPTIONAL, .name = "curve", .unit = "Pa", .x_unit = "1",
              .doc = "Strength over strain.", .min = 0, .max = HUGE_VAL, .min_count = 2);
static const gault_parameter* const material_parameters[] = {
    &stiffness, &ratio, &angle, &limit, &count, &drained, &shape, &label, &properties, &curve, NULL};

static gault_status update(const void* self, gault_points* points, gault_error* error) {
    (void)self, (void)error;
    for (int i = 0; i < 6; ++i)
        memcpy(points->stress[i], points->stress_old[i], (size_t)points->padded * sizeof(double));
    return GAULT_OK;
}
static const gault_material_api material_api = {.size = sizeof(gault_material_api), .update = update};
static const gault_component material = {.size = sizeof(gault_component),
                                         .kind = GAULT_MATERIAL,
                                         .name = "test_material",
                                         .version = "1",
                                         .doc = "Stress that stays.",
                                         .reference = "",
                                         .parameters = material_parameters,
                                         .api = &material_api,
                                         .create = create,
                                         .destroy = destroy};

/* ---- boundaries ---- */

static const gault_parameter* const no_parameters[] = {NULL};

static gault_status constrain(const void* self, gault_nodes* nodes, gault_error* error) {
    (void)self, (void)nodes, (void)error;
    return GAULT_OK;
}
static const gault_boundary_api clamp_api = {.size = sizeof(gault_boundary_api), .constrain = constrain};
static const gault_component clamp = {.size = sizeof(gault_component),
                                      .kind = GAULT_BOUNDARY,
                                      .name = "test_clamp",
                                      .version = "1",
                                      .doc = "Leaves the nodes alone.",
                                      .reference = "",
                                      .parameters = no_parameters,
                                      .api = &clamp_api,
                                      .create = create,
                                      .destroy = destroy};

static const gault_parameter value =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED, .name = "value", .unit = "Pa",
              .doc = "The load, compression positive.", .min = 0, .max = HUGE_VAL);
static const gault_parameter* const load_parameters[] = {&value, NULL};
static gault_status load(const void* self, gault_facets* facets, gault_error* error) {
    (void)self, (void)facets, (void)error;
    return GAULT_OK;
}
static const gault_boundary_api load_api = {.size = sizeof(gault_boundary_api), .load = load};
static const gault_component loaded = {.size = sizeof(gault_component),
                                       .kind = GAULT_BOUNDARY,
                                       .name = "test_load",
                                       .version = "1",
                                       .doc = "Loads nothing.",
                                       .reference = "",
                                       .parameters = load_parameters,
                                       .api = &load_api,
                                       .create = create,
                                       .destroy = destroy};

/* ---- programs ---- */

static const gault_parameter rate =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED | GAULT_MIN_OPEN, .name = "rate", .unit = "m/s",
              .doc = "Speed.", .min = 0, .max = HUGE_VAL);
static const gault_parameter duration =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED | GAULT_MIN_OPEN, .name = "duration", .unit = "s",
              .doc = "How long.", .min = 0, .max = HUGE_VAL);
static const gault_parameter strain =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED, .name = "strain", .unit = "1", .doc = "How far.",
              .min = -HUGE_VAL, .max = HUGE_VAL);
static const gault_parameter* const push_parameters[] = {&rate, &duration, NULL};
static const gault_parameter* const strain_parameters[] = {&strain, NULL};
static const gault_record_kind push = {sizeof(gault_record_kind), 0, "push", "Pushes.", push_parameters};
static const gault_record_kind reach = {sizeof(gault_record_kind), 0, "reach", "Goes to a strain.",
                                        strain_parameters};
static const gault_record_kind rest = {sizeof(gault_record_kind), 0, "rest", "Waits.", no_parameters};
static const gault_record_kind* const inner_kinds[] = {&push, &reach, &rest, NULL};
static const gault_parameter times = PARAMETER(.type = GAULT_INTEGER, .name = "times", .unit = "1",
                                               .doc = "How often.", .fallback = 1, .min = 1, .max = HUGE_VAL);
static const gault_parameter steps =
    PARAMETER(.type = GAULT_RECORDS, .flags = GAULT_REQUIRED, .name = "steps", .unit = "1",
              .doc = "What is repeated.", .kinds = inner_kinds, .min_count = 1);
static const gault_parameter* const repeat_parameters[] = {&times, &steps, NULL};
static const gault_parameter* const group_parameters[] = {&steps, NULL};
static const gault_record_kind repeat = {sizeof(gault_record_kind), 0, "repeat", "Repeats.",
                                         repeat_parameters};
static const gault_record_kind group = {sizeof(gault_record_kind), 0, "group", "Holds together.",
                                        group_parameters};
static const gault_record_kind* const phase_kinds[] = {&push, &reach, &rest, &repeat, &group, NULL};
static const gault_parameter phases =
    PARAMETER(.type = GAULT_RECORDS, .flags = GAULT_REQUIRED, .name = "phases", .unit = "1",
              .doc = "What is done, in order.", .kinds = phase_kinds, .min_count = 1, .max_count = 5);
static const gault_parameter* const program_parameters[] = {&phases, NULL};

static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    (void)self, (void)error;
    step->done = 1;
    return GAULT_OK;
}
static const gault_signal records[] = {{"wall_strain", "1", "How far the wall went.", 0},
                                       {"wall_pressure", "Pa", "On the wall.", 0}};
static const gault_program_signals signals = {
    .size = sizeof(gault_program_signals), .records = records, .record_count = 2};
static const gault_program_api program_api = {
    .size = sizeof(gault_program_api), .signals = &signals, .advance = advance};
static const gault_component program = {.size = sizeof(gault_component),
                                        .kind = GAULT_PROGRAM,
                                        .name = "test_program",
                                        .version = "1",
                                        .doc = "Ends at once.",
                                        .reference = "",
                                        .parameters = program_parameters,
                                        .api = &program_api,
                                        .create = create,
                                        .destroy = destroy};

/* Records that are known only once the program was created. */
static const gault_signal late_record = {"late_pressure", "Pa", "Recorded by this instance.", 0};
static const gault_program_signals late_signals = {
    .size = sizeof(gault_program_signals), .records = &late_record, .record_count = 1};
static const gault_program_signals* instance_signals(const void* self) {
    return self == &instance ? &late_signals : NULL;
}
static const gault_program_api late_api = {.size = sizeof(gault_program_api),
                                           .signals = &signals,
                                           .advance = advance,
                                           .instance_signals = instance_signals};
static const gault_component late = {.size = sizeof(gault_component),
                                     .kind = GAULT_PROGRAM,
                                     .name = "test_late_program",
                                     .version = "1",
                                     .doc = "Says late what it records.",
                                     .reference = "",
                                     .parameters = no_parameters,
                                     .api = &late_api,
                                     .create = create,
                                     .destroy = destroy};

/* ---- observer ---- */

static gault_status evaluate(const void* self, gault_sample* sample, gault_error* error) {
    (void)self, (void)error;
    sample->result[0] = 0.0;
    return GAULT_OK;
}
static const gault_signal results[] = {{"nothing", "1", "Always zero.", 0}};
static const gault_observer_api observer_api = {
    .size = sizeof(gault_observer_api), .results = results, .result_count = 1, .evaluate = evaluate};
static const gault_component observer = {.size = sizeof(gault_component),
                                         .kind = GAULT_OBSERVER,
                                         .name = "test_observer",
                                         .version = "1",
                                         .doc = "Sees nothing.",
                                         .reference = "",
                                         .parameters = load_parameters,
                                         .api = &observer_api,
                                         .create = create,
                                         .destroy = destroy};

static const gault_component* const components[] = {&material, &clamp,    &loaded, &program,
                                                    &late,     &observer, NULL};

GAULT_EXPORT const gault_module GAULT_ENTRY = {.magic = GAULT_MAGIC,
                                               .abi_major = GAULT_ABI_MAJOR,
                                               .abi_minor = GAULT_ABI_MINOR,
                                               .size = sizeof(gault_module),
                                               .needs_minor = 0,
                                               .pointer_bytes = sizeof(void*),
                                               .real_bytes = sizeof(double),
                                               .name = "test_components",
                                               .version = "1",
                                               .author = "",
                                               .license = "",
                                               .built_with = "",
                                               .components = components};
