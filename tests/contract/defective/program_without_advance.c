#include <gault/gault.h>
static const gault_program_signals none = {.size = sizeof none};
static const gault_program_api idle = {.size = sizeof idle, .signals = &none};
#define COMPONENT .kind = GAULT_PROGRAM, .api = &idle
#include "tiny.h"
