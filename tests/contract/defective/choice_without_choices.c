#define PARAMETER .type = GAULT_CHOICE
#include "tiny.h"
