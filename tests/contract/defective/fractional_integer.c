#define PARAMETER .flags = 0, .type = GAULT_INTEGER, .fallback = 1.5
#include "tiny.h"
