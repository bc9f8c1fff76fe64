#include <gault/gault.h>
static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    (void)self, (void)step, (void)error;
    return GAULT_OK;
}
static const gault_signal records[] = {
    {.name = "depth", .unit = "m", .doc = "Depth.", .flags = GAULT_SIGNAL_OPTIONAL}};
static const gault_program_signals signals = {.size = sizeof signals, .records = records, .record_count = 1};
static const gault_program_api scribe = {.size = sizeof scribe, .signals = &signals, .advance = advance};
#define COMPONENT .kind = GAULT_PROGRAM, .api = &scribe
#include "tiny.h"
