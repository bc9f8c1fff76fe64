#include <gault/gault.h>
#include <xmmintrin.h>
static gault_status change(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    (void)host, (void)values, (void)self, (void)error;
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    return GAULT_OK;
}
#define COMPONENT .create = change
#include "tiny.h"
