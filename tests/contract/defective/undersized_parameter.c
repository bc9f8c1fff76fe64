#define PARAMETER .size = 4
#include "tiny.h"
