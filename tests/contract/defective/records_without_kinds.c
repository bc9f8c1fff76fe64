#define PARAMETER .type = GAULT_RECORDS
#include "tiny.h"
