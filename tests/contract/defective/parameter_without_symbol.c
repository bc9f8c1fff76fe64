#define PARAMETER .symbol = NULL
#include "tiny.h"
