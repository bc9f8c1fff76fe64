#define PARAMETER .min = 2, .max = 1
#include "tiny.h"
