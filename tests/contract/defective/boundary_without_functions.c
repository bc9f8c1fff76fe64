#include <gault/gault.h>
static const gault_boundary_api idle = {.size = sizeof idle};
#define COMPONENT .kind = GAULT_BOUNDARY, .api = &idle
#include "tiny.h"
