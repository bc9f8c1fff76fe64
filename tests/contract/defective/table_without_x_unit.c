#define PARAMETER .type = GAULT_TABLE
#include "tiny.h"
