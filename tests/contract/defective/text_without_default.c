#define PARAMETER .flags = 0, .type = GAULT_TEXT_VALUE
#include "tiny.h"
