#include <gault/gault.h>
static const gault_observer_api blind = {.size = sizeof blind};
#define COMPONENT .kind = GAULT_OBSERVER, .api = &blind
#include "tiny.h"
