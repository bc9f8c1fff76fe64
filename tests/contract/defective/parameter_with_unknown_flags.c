#define PARAMETER .flags = 0x10
#include "tiny.h"
