#define PARAMETER .flags = 0, .type = GAULT_INTEGER, .fallback = HUGE_VAL
#include "tiny.h"
