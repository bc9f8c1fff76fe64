#define MODULE .reserved = 1
#include "tiny.h"
