#include "parts.h"

/* ---- holds what crosses a surface where it was ---------------------------------------------------------- */

static const gault_parameter* const no_parameters[] = {NULL};

static gault_status create_slide(const gault_host* host, const gault_value* values, void** self,
                                 gault_error* error) {
    (void)values;
    return make(host, 1, self, error);
}

static gault_status constrain(const void* self, gault_nodes* n, gault_error* error) {
    (void)self;
    if (HAS_LATER(n, gault_nodes) || n->padded % GAULT_LANES || n->padded < n->count || n->time < n->dt)
        return because(GAULT_FAILED, error, -1, -1, "the nodes are none of this host's");
    for (int64_t i = 0; i < n->count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            if (!isfinite(n->position[axis][i])) return because(GAULT_FAILED, error, -1, i, "a node is lost");
            if (fabs(n->normal[axis][i]) < 0.7) continue;
            n->fixed[axis][i] = 1.0;
            n->velocity[axis][i] = n->dt > 0.0 ? -n->displacement[axis][i] / n->dt : 0.0;
        }
    return GAULT_OK;
}

static const gault_boundary_api slide_api = {.size = sizeof slide_api,
                                             WITH_LATER.flags =
                                                 GAULT_BOUNDARY_UNIFORM | GAULT_BOUNDARY_HOLDS_NORMAL,
                                             .constrain = constrain};
const gault_component slide = COMPONENT(GAULT_BOUNDARY, "in_c_slide", "Holds the normal component.",
                                        no_parameters, &slide_api, create_slide);

/* ---- a pressure that a program commands, beside a spring and a dashpot ---------------------------------- */

typedef struct Plate {
    double spring;
    int absorbs;
} Plate;

enum { SPRING, ABSORBS };
static const gault_parameter spring =
    PARAMETER(.type = GAULT_REAL, .name = "spring", .unit = "1/m",
              .doc = "Stiffness over the shear modulus of the soil behind.", .min = 0.0, .max = HUGE_VAL);
static const gault_parameter absorbs = PARAMETER(.type = GAULT_BOOLEAN, .name = "absorbs", .unit = "1",
                                                 .doc = "Whether it absorbs waves.", .fallback = 1.0);
static const gault_parameter* const plate_parameters[] = {&spring, &absorbs, NULL};

static gault_status create_plate(const gault_host* host, const gault_value* values, void** self,
                                 gault_error* error) {
    const gault_status status = make(host, sizeof(Plate), self, error);
    if (status == GAULT_OK) *(Plate*)*self = (Plate){values[SPRING].real, (int)values[ABSORBS].integer};
    return status;
}

static gault_status load(const void* self, gault_facets* f, gault_error* error) {
    const Plate* plate = self;
    if (HAS_LATER(f, gault_facets) || f->padded % GAULT_LANES || f->time < f->dt)
        return because(GAULT_FAILED, error, -1, -1, "the facets are none of this host's");
    for (int64_t i = 0; i < f->count; ++i) {
        const double stiffness = plate->spring * f->shear_modulus[i];
        f->pressure[i] = f->control[0];
        for (int axis = 0; axis < 3; ++axis) {
            const double impedance = f->impedance[fabs(f->normal[axis][i]) > 0.7 ? 0 : 1][i];
            f->traction[axis][i] = f->initial_traction[axis][i] - stiffness * f->displacement[axis][i] -
                                   (plate->absorbs ? impedance * f->velocity[axis][i] : 0.0);
            if (f->slope[0]) f->slope[4 * axis][i] = stiffness;
        }
    }
    return GAULT_OK;
}

static const gault_signal commanded[] = {
    {.name = "pressure", .unit = "Pa", .doc = "Beside the initial stress.", .initial = 0.0}};

static const gault_boundary_api plate_api = {
    .size = sizeof plate_api, WITH_LATER.controls = commanded, .control_count = 1, .load = load};
const gault_component plate = COMPONENT(GAULT_BOUNDARY, "in_c_plate", "Pressure, spring and dashpot.",
                                        plate_parameters, &plate_api, create_plate);

static const gault_boundary_api beyond_api = {.size = sizeof beyond_api,
                                              WITH_LATER.flags = GAULT_BOUNDARY_ELASTIC_BEHIND,
                                              .controls = commanded,
                                              .control_count = 1,
                                              .load = load};
const gault_component beyond = COMPONENT(GAULT_BOUNDARY, "in_c_beyond", "Elastic soil without end.",
                                         plate_parameters, &beyond_api, create_plate);
