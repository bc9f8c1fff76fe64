#include <gault/gault.h>
static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    (void)self, (void)step, (void)error;
    return GAULT_OK;
}
static const gault_program_signals none = {.size = sizeof none};
static const gault_program_api brief = {.size = 32, .signals = &none, .advance = advance};
#define COMPONENT .kind = GAULT_PROGRAM, .api = &brief
#include "tiny.h"
