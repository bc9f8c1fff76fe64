/* Looks at everything that an observer is shown, and says what is known of it beforehand. */
#include "parts.h"

#include <string.h>

static const gault_parameter width =
    PARAMETER(.type = GAULT_REAL, .name = "width", .unit = "m", .doc = "Of the body.", .fallback = 1.0,
              .min = 0.0, .max = HUGE_VAL);
static const gault_parameter* const parameters[] = {&width, NULL};

static gault_status create(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    const gault_status status = make(host, sizeof(double), self, error);
    if (status == GAULT_OK) *(double*)*self = values[0].real;
    return status;
}

enum { NORMAL_FORCE, AREA };
static const gault_signal measures[] = {{.name = "normal_force", .unit = "N", .doc = "On the surface."},
                                        {.name = "area", .unit = "m^2", .doc = "Of the surface."}};
enum { DENSITY, VOLUME_RATIO, LENGTH, NOBODYS };
static const char* const fields[] = {"density", "volume_ratio", "length", "nobodys", NULL};
enum {
    STRESS_ERROR,
    INITIAL_DENSITY,
    CELL_LENGTH,
    HEIGHT,
    SETTLEMENT,
    UPPER_SHARE,
    END,
    SIZE,
    NEVER,
    RESULTS
};
static const gault_signal results[] = {
    [STRESS_ERROR] = {.name = "stress_error",
                      .unit = "1",
                      .doc = "Of the vertical stress at the worst point."},
    [INITIAL_DENSITY] = {.name = "initial_density", .unit = "kg/m^3", .doc = "Of the lower soil."},
    [CELL_LENGTH] = {.name = "cell_length", .unit = "m", .doc = "That the lower soil was told."},
    [HEIGHT] = {.name = "height", .unit = "m", .doc = "Volume over width."},
    [SETTLEMENT] = {.name = "settlement", .unit = "m", .doc = "Largest of a point."},
    [UPPER_SHARE] = {.name = "upper_share", .unit = "1", .doc = "Share of points in the upper soil."},
    [END] = {.name = "end", .unit = "s", .doc = "Time."},
    [SIZE] = {.name = "size", .unit = "m", .doc = "Height of a cell."},
    [NEVER] = {.name = "never", .unit = "1", .doc = "Not applicable."}};

static void look_at(gault_sample* s, int64_t i, double pressure) {
    double* r = s->result;
    r[STRESS_ERROR] = fmax(r[STRESS_ERROR], fabs(s->stress[1][i] + pressure) / pressure);
    r[HEIGHT] += s->volume[i];
    r[SETTLEMENT] = fmax(r[SETTLEMENT], s->reference_position[1][i] - s->position[1][i]);
    if (strcmp(s->material_name[s->material[i]], "upper") == 0) {
        r[UPPER_SHARE] += 1.0 / (double)s->count;
    } else {
        r[INITIAL_DENSITY] = s->field[DENSITY][i] * s->field[VOLUME_RATIO][i];
        r[CELL_LENGTH] = s->field[LENGTH][i];
    }
}

static gault_status evaluate(const void* self, gault_sample* s, gault_error* error) {
    if (HAS_LATER(s, gault_sample) || s->field[NOBODYS])
        return because(GAULT_FAILED, error, -1, -1, "a sample that is none of this host's");
    for (int k = 0; k < RESULTS; ++k)
        s->result[k] = 0.0;
    for (int64_t i = 0; i < s->count; ++i)
        look_at(s, i, s->measure[NORMAL_FORCE] / s->measure[AREA]);
    s->result[HEIGHT] /= *(const double*)self;
    s->result[END] = s->time;
    s->result[SIZE] = s->cell_size[1];
    s->result[NEVER] = NAN;
    return GAULT_OK;
}

static const gault_observer_api api = {.size = sizeof api,
                                       WITH_LATER.measures = measures,
                                       .results = results,
                                       .fields = fields,
                                       .measure_count = 2,
                                       .result_count = RESULTS,
                                       .evaluate = evaluate};
const gault_component witness =
    COMPONENT(GAULT_OBSERVER, "in_c_witness", "Looks at everything.", parameters, &api, create);
