#include "parts.h"

static double trace(const double* const tensor[6], int64_t i) {
    return tensor[0][i] + tensor[1][i] + tensor[2][i];
}

static void answer_moduli(const gault_points* p, int64_t i, double lame, double shear) {
    if (p->modulus) p->modulus[i] = lame + 2.0 * shear;
    if (p->shear_modulus) p->shear_modulus[i] = shear;
}

/* ---- Hooke's law in rate form, with states of every shape and a record of every input ------------------- */

typedef struct Elastic {
    double lame, shear, largest_increment;
} Elastic;

enum { STIFFNESS, POISSON_RATIO, LARGEST_INCREMENT };
static const gault_parameter stiffness =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED | GAULT_MIN_OPEN, .name = "stiffness", .unit = "Pa",
              .doc = "Young's modulus.", .min = 0.0, .max = HUGE_VAL);
static const gault_parameter poisson_ratio =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_MIN_OPEN | GAULT_MAX_OPEN, .name = "poisson_ratio",
              .unit = "1", .doc = "Poisson's ratio.", .fallback = 0.25, .min = -1.0, .max = 0.5);
static const gault_parameter largest_increment =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_OPTIONAL, .name = "largest_increment", .unit = "1",
              .doc = "Strain of a step beyond which it asks for less.", .min = 0.0, .max = HUGE_VAL);
static const gault_parameter* const elastic_parameters[] = {&stiffness, &poisson_ratio, &largest_increment,
                                                            NULL};

static gault_status create_elastic(const gault_host* host, const gault_value* values, void** self,
                                   gault_error* error) {
    if (values[STIFFNESS].real > 1e12)
        return because(GAULT_INVALID, error, STIFFNESS, -1, "is that of no soil");
    const gault_status status = make(host, sizeof(Elastic), self, error);
    if (status != GAULT_OK) return status;
    Elastic* soil = *self;
    const double nu = values[POISSON_RATIO].real;
    soil->shear = values[STIFFNESS].real / (2.0 * (1.0 + nu));
    soil->lame = 2.0 * soil->shear * nu / (1.0 - 2.0 * nu);
    soil->largest_increment = values[LARGEST_INCREMENT].count ? values[LARGEST_INCREMENT].real : HUGE_VAL;
    return GAULT_OK;
}

enum { AGE, MARKER, STRAIN = MARKER + GAULT_VECTOR, INPUTS = STRAIN + GAULT_SYMMETRIC };
static const gault_state elastic_states[] = {
    {.name = "age", .unit = "s", .doc = "Time so far.", .shape = GAULT_SCALAR, .max = HUGE_VAL},
    {.name = "marker",
     .unit = "1",
     .doc = "Turns with the soil.",
     .shape = GAULT_VECTOR,
     .initial = 1.0,
     .min = -2.0,
     .max = 2.0},
    {.name = "strain",
     .unit = "1",
     .doc = "Sum of increments.",
     .shape = GAULT_SYMMETRIC,
     .min = -HUGE_VAL,
     .max = HUGE_VAL},
    {.name = "density", .unit = "kg/m^3", .doc = "As told.", .shape = GAULT_SCALAR, .max = HUGE_VAL},
    {.name = "volume_ratio", .unit = "1", .doc = "As told.", .shape = GAULT_SCALAR, .max = HUGE_VAL},
    {.name = "length", .unit = "m", .doc = "As told.", .shape = GAULT_SCALAR, .max = HUGE_VAL}};
static const char* const elastic_inputs[] = {"density", "volume_ratio", "characteristic_length", NULL};

static void remember(gault_points* p, int64_t i) {
    p->state[AGE][i] = p->state_old[AGE][i] + p->dt;
    for (int c = 0; c < GAULT_VECTOR; ++c)
        p->state[MARKER + c][i] = p->state_old[MARKER + c][i];
    for (int c = 0; c < GAULT_SYMMETRIC; ++c)
        p->state[STRAIN + c][i] = p->state_old[STRAIN + c][i] + p->strain[c][i];
    for (int c = 0; elastic_inputs[c]; ++c)
        p->state[INPUTS + c][i] = p->input[c][i];
}

static void answer_elastic(const Elastic* soil, gault_points* p, int64_t i) {
    const double mean = soil->lame * trace(p->strain, i);
    for (int c = 0; c < 6; ++c)
        p->stress[c][i] = p->stress_old[c][i] + (c < 3 ? mean : 0.0) + 2.0 * soil->shear * p->strain[c][i];
    remember(p, i);
    answer_moduli(p, i, soil->lame, soil->shear);
    for (int row = 0; row < 6 && p->tangent[0]; ++row)
        for (int column = 0; column < 6; ++column)
            p->tangent[6 * row + column][i] =
                (row < 3 && column < 3 ? soil->lame : 0.0) + (row == column ? 2.0 * soil->shear : 0.0);
}

static gault_status update_elastic(const void* self, gault_points* p, gault_error* error) {
    const Elastic* soil = self;
    if (HAS_LATER(p, gault_points) || p->size < offsetof(gault_points, F_new) || p->padded % GAULT_LANES)
        return because(GAULT_FAILED, error, -1, -1, "the batch is none of this host's");
    double largest = 0.0;
    for (int64_t i = 0; i < p->count; ++i) {
        for (int c = 0; c < 6; ++c)
            largest = fmax(largest, fabs(p->strain[c][i]));
        answer_elastic(soil, p, i);
        if (fabs(p->state[AGE][i] - p->time) > 1e-9 * p->time)
            return because(GAULT_FAILED, error, -1, i, "the steps do not add up to the time");
    }
    if (largest <= soil->largest_increment) return GAULT_OK;
    p->suggest = 0.9 * soil->largest_increment / largest;
    return GAULT_RETRY;
}

static const gault_material_api elastic_api = {.size = sizeof elastic_api,
                                               WITH_LATER.flags = GAULT_HAS_TANGENT,
                                               .states = elastic_states,
                                               .inputs = elastic_inputs,
                                               .state_count = sizeof elastic_states / sizeof *elastic_states,
                                               .update = update_elastic};
const gault_component elastic = COMPONENT(GAULT_MATERIAL, "in_c_elastic", "Hooke's law.", elastic_parameters,
                                          &elastic_api, create_elastic);

/* ---- Neo-Hookean and viscous, from the deformation gradient, with a global variable --------------------- */

typedef struct NeoHookean {
    double lame, shear, viscosity;
} NeoHookean;

enum { SHEAR_MODULUS, LAME, VISCOSITY };
static const gault_parameter shear_modulus =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED | GAULT_MIN_OPEN, .name = "shear_modulus",
              .unit = "Pa", .doc = "At rest.", .min = 0.0, .max = HUGE_VAL);
static const gault_parameter lame = PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED, .name = "lame",
                                              .unit = "Pa", .doc = "At rest.", .min = 0.0, .max = HUGE_VAL);
static const gault_parameter viscosity =
    PARAMETER(.type = GAULT_REAL, .name = "viscosity", .unit = "Pa s", .doc = "Of the rate of strain.",
              .fallback = 0.0, .min = 0.0, .max = HUGE_VAL);
static const gault_parameter* const neo_hookean_parameters[] = {&shear_modulus, &lame, &viscosity, NULL};

static gault_status create_neo_hookean(const gault_host* host, const gault_value* values, void** self,
                                       gault_error* error) {
    const gault_status status = make(host, sizeof(NeoHookean), self, error);
    if (status == GAULT_OK)
        *(NeoHookean*)*self =
            (NeoHookean){values[LAME].real, values[SHEAR_MODULUS].real, values[VISCOSITY].real};
    return status;
}

enum { REST_STRESS, RATE = GAULT_SYMMETRIC };
static const gault_state neo_hookean_states[] = {{.name = "rest_stress",
                                                  .unit = "Pa",
                                                  .doc = "Initial stress.",
                                                  .shape = GAULT_SYMMETRIC,
                                                  .min = -HUGE_VAL,
                                                  .max = HUGE_VAL},
                                                 {.name = "rate",
                                                  .unit = "1/s",
                                                  .doc = "Of volumetric strain.",
                                                  .shape = GAULT_SCALAR,
                                                  .min = -HUGE_VAL,
                                                  .max = HUGE_VAL}};

static const gault_state* states_of(const void* self, uint32_t* count) {
    *count = ((const NeoHookean*)self)->viscosity > 0.0 ? 2 : 1;
    return neo_hookean_states;
}

static double determinant(const double* const F[9], int64_t i) {
    return F[0][i] * (F[4][i] * F[8][i] - F[5][i] * F[7][i]) -
           F[1][i] * (F[3][i] * F[8][i] - F[5][i] * F[6][i]) +
           F[2][i] * (F[3][i] * F[7][i] - F[4][i] * F[6][i]);
}

static void answer_neo_hookean(const NeoHookean* soil, gault_points* p, int64_t i) {
    static const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
    const double volume = determinant(p->F_new, i);
    for (int c = 0; c < 6; ++c) {
        double b = 0.0; /* of F F^T */
        for (int k = 0; k < 3; ++k)
            b += p->F_new[3 * row[c] + k][i] * p->F_new[3 * column[c] + k][i];
        const double unit = c < 3 ? 1.0 : 0.0;
        const double viscous = p->dt > 0.0 ? soil->viscosity * p->strain[c][i] / p->dt : 0.0;
        p->state[REST_STRESS + c][i] = p->state_old[REST_STRESS + c][i];
        p->stress[c][i] = p->state[REST_STRESS + c][i] + viscous +
                          (soil->shear * (b - unit) + soil->lame * log(volume) * unit) / volume;
    }
    if (soil->viscosity > 0.0) p->state[RATE][i] = p->dt > 0.0 ? trace(p->strain, i) / p->dt : 0.0;
    answer_moduli(p, i, soil->lame, soil->shear);
}

static gault_status update_neo_hookean(const void* self, gault_points* p, gault_error* error) {
    static volatile int calls_at_once; /* the legacy that ONE_AT_A_TIME is for */
    if (++calls_at_once > 1) return because(GAULT_FAILED, error, -1, -1, "called twice at once");
    for (int64_t i = 0; i < p->count; ++i) {
        if (!(determinant(p->F_old, i) > 0.0 && determinant(p->F_new, i) > 0.0)) {
            --calls_at_once;
            return because(GAULT_FAILED, error, -1, i, "turned inside out");
        }
        answer_neo_hookean(self, p, i);
    }
    --calls_at_once;
    return GAULT_OK;
}

static gault_status start_neo_hookean(const void* self, gault_points* p, gault_error* error) {
    (void)self;
    for (int64_t i = 0; i < p->count; ++i) {
        if (trace(p->stress_old, i) > 0.0)
            return because(GAULT_FAILED, error, -1, i, "the initial stress is tensile");
        for (int c = 0; c < 6; ++c)
            p->state[REST_STRESS + c][i] = p->stress[c][i];
    }
    return GAULT_OK;
}

static const gault_material_api neo_hookean_api = {
    .size = sizeof neo_hookean_api,
    WITH_LATER.flags = GAULT_FINITE_STRAIN | GAULT_RATE_DEPENDENT | GAULT_ONE_AT_A_TIME,
    .update = update_neo_hookean,
    .start = start_neo_hookean,
    .instance_states = states_of};
const gault_component neo_hookean = COMPONENT(GAULT_MATERIAL, "in_c_neo_hookean", "Rubber that creeps.",
                                              neo_hookean_parameters, &neo_hookean_api, create_neo_hookean);
