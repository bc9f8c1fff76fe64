#define PARAMETER .unit = NULL
#include "tiny.h"
