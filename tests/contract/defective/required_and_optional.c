#define PARAMETER .flags = GAULT_REQUIRED | GAULT_OPTIONAL
#include "tiny.h"
