#include <gault/gault.h>
static gault_status hold(const void *self, gault_nodes *nodes, gault_error *error) {
    return (void)self, (void)nodes, (void)error, GAULT_OK;
}
static const gault_boundary_api odd = {.size = sizeof odd, .flags = 1u << 5, .constrain = hold};
#define COMPONENT .kind = GAULT_BOUNDARY, .api = &odd
#include "tiny.h"
