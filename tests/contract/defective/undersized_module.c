#define MODULE .size = 32
#include "tiny.h"
