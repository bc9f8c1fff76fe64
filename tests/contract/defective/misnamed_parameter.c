#define PARAMETER .name = "2k"
#include "tiny.h"
