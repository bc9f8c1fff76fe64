#define API .flags = 0x10
#include "tiny.h"
