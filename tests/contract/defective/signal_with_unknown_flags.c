#include <gault/gault.h>
static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    (void)self, (void)step, (void)error;
    return GAULT_OK;
}
static const gault_signal controls[] = {
    {.name = "speed", .unit = "m/s", .doc = "Speed.", .flags = GAULT_SIGNAL_OPTIONAL | 4u}};
static const gault_program_signals signals = {
    .size = sizeof signals, .controls = controls, .control_count = 1};
static const gault_program_api driver = {.size = sizeof driver, .signals = &signals, .advance = advance};
#define COMPONENT .kind = GAULT_PROGRAM, .api = &driver
#include "tiny.h"
