#define PARAMETER .type = GAULT_LIST, .min_count = 5, .max_count = 2
#include "tiny.h"
