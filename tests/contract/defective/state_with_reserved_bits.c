#define STATE .shape = GAULT_SCALAR, .reserved = 1
#include "tiny.h"
