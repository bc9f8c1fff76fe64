#define PARAMETER .min = 1, .max = 1, .flags = GAULT_REQUIRED | GAULT_MIN_OPEN
#include "tiny.h"
