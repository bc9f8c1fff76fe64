#define PARAMETER .name = NULL
#include "tiny.h"
