#define PARAMETER .flags = 0, .type = GAULT_BOOLEAN, .fallback = 0.5
#include "tiny.h"
