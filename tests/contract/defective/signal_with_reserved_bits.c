#include <gault/gault.h>
static gault_status load(const void* self, gault_facets* facets, gault_error* error) {
    (void)self, (void)facets, (void)error;
    return GAULT_OK;
}
static const gault_signal controls[] = {{.name = "pressure", .unit = "Pa", .doc = "Pressure.", .reserved = 1u}};
static const gault_boundary_api press = {
    .size = sizeof press, .controls = controls, .control_count = 1, .load = load};
#define COMPONENT .kind = GAULT_BOUNDARY, .api = &press
#include "tiny.h"
