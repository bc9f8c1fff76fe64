/* A whole plugin in C11: an isotropic soil whose stiffness grows with pressure, E = E0 + m p, and which
 * remembers the largest pressure that it has borne. Tension positive; p = -tr(stress) / 3. */
#include <gault/gault.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STIFFNESS, GROWTH, POISSON_RATIO, PARAMETER_COUNT };

typedef struct Soil {
    double stiffness, growth, poisson_ratio;
} Soil;

static gault_status create(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    if (values[GROWTH].real > 1e3 && values[POISSON_RATIO].real > 0.4) {
        error->parameter = GROWTH;
        snprintf(error->text, sizeof error->text, "%g is too much for a Poisson's ratio above 0.4",
                 values[GROWTH].real);
        return GAULT_INVALID;
    }
    Soil* soil = malloc(sizeof *soil);
    if (!soil) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return GAULT_FAILED;
    }
    *soil = (Soil){values[STIFFNESS].real, values[GROWTH].real, values[POISSON_RATIO].real};
    host->log(host->self, GAULT_DEBUG, "hypoelastic: created");
    *self = soil;
    return GAULT_OK;
}

static void destroy(void* self) {
    free(self);
}

static double pressure(double* const stress[6], int64_t i) {
    return -(stress[0][i] + stress[1][i] + stress[2][i]) / 3.0;
}

static void update_point(const Soil* soil, gault_points* p, int64_t i) {
    const double borne = p->state_old[0][i];
    const double old = -(p->stress_old[0][i] + p->stress_old[1][i] + p->stress_old[2][i]) / 3.0;
    const double young = soil->stiffness + soil->growth * fmax(old, 0.0);
    const double shear = young / (2.0 * (1.0 + soil->poisson_ratio));
    const double lame = 2.0 * shear * soil->poisson_ratio / (1.0 - 2.0 * soil->poisson_ratio);
    const double volumetric = p->strain[0][i] + p->strain[1][i] + p->strain[2][i];
    for (int c = 0; c < 6; ++c)
        p->stress[c][i] =
            p->stress_old[c][i] + (c < 3 ? lame * volumetric : 0.0) + 2.0 * shear * p->strain[c][i];
    p->state[0][i] = fmax(borne, pressure(p->stress, i));
    if (p->modulus) p->modulus[i] = lame + 2.0 * shear;
    if (p->shear_modulus) p->shear_modulus[i] = shear;
}

static gault_status update(const void* self, gault_points* points, gault_error* error) {
    for (int64_t i = 0; i < points->count; ++i) {
        update_point(self, points, i);
        if (isfinite(points->stress[0][i])) continue;
        error->point = i;
        snprintf(error->text, sizeof error->text, "the stress is not finite");
        return GAULT_FAILED;
    }
    return GAULT_OK;
}

static gault_status start(const void* self, gault_points* points, gault_error* error) {
    (void)self, (void)error;
    for (int64_t i = 0; i < points->count; ++i)
        points->state[0][i] = fmax(pressure(points->stress, i), 0.0);
    return GAULT_OK;
}

static const gault_parameter stiffness = {.size = sizeof stiffness,
                                          .type = GAULT_REAL,
                                          .flags = GAULT_REQUIRED | GAULT_MIN_OPEN,
                                          .name = "stiffness",
                                          .symbol = "E0",
                                          .unit = "Pa",
                                          .doc = "Young's modulus without pressure.",
                                          .min = 0.0,
                                          .max = HUGE_VAL};
static const gault_parameter growth = {.size = sizeof growth,
                                       .type = GAULT_REAL,
                                       .name = "growth",
                                       .symbol = "m",
                                       .unit = "1",
                                       .doc = "Growth of Young's modulus with pressure.",
                                       .fallback = 0.0,
                                       .min = 0.0,
                                       .max = HUGE_VAL};
static const gault_parameter poisson_ratio = {.size = sizeof poisson_ratio,
                                              .type = GAULT_REAL,
                                              .flags = GAULT_MIN_OPEN | GAULT_MAX_OPEN,
                                              .name = "poisson_ratio",
                                              .symbol = "nu",
                                              .unit = "1",
                                              .doc = "Poisson's ratio.",
                                              .fallback = 0.25,
                                              .min = -1.0,
                                              .max = 0.5};
static const gault_parameter* const parameters[PARAMETER_COUNT + 1] = {
    [STIFFNESS] = &stiffness, [GROWTH] = &growth, [POISSON_RATIO] = &poisson_ratio};

static const gault_state states[] = {{.name = "borne_pressure",
                                      .unit = "Pa",
                                      .doc = "Largest pressure so far.",
                                      .shape = GAULT_SCALAR,
                                      .initial = 0.0,
                                      .min = 0.0,
                                      .max = HUGE_VAL}};

static const gault_material_api api = {
    .size = sizeof api, .states = states, .state_count = 1, .update = update, .start = start};

static const gault_component component = {.size = sizeof component,
                                          .kind = GAULT_MATERIAL,
                                          .name = "hypoelastic",
                                          .version = "1.2.0",
                                          .doc = "Isotropic, stiffer under pressure.",
                                          .reference = "",
                                          .parameters = parameters,
                                          .api = &api,
                                          .create = create,
                                          .destroy = destroy};
static const gault_component* const components[] = {&component, NULL};

GAULT_EXPORT const gault_module GAULT_ENTRY = {.magic = GAULT_MAGIC,
                                               .abi_major = GAULT_ABI_MAJOR,
                                               .abi_minor = GAULT_ABI_MINOR,
                                               .size = sizeof(gault_module),
                                               .needs_minor = 0,
                                               .pointer_bytes = sizeof(void*),
                                               .real_bytes = sizeof(double),
                                               .name = "hypoelastic",
                                               .version = "1.2.0",
                                               .author = "The Gault authors",
                                               .license = "MIT",
                                               .built_with = __VERSION__,
                                               .components = components};
