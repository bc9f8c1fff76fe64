#include <xmmintrin.h>
__attribute__((constructor)) static void change(void) {
    _MM_SET_ROUNDING_MODE(_MM_ROUND_TOWARD_ZERO);
}
#include "tiny.h"
