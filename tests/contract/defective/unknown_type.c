#define PARAMETER .type = 17
#include "tiny.h"
