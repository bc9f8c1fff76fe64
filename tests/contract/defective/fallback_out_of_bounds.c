#define PARAMETER .flags = GAULT_MIN_OPEN, .fallback = 0, .min = 0
#include "tiny.h"
