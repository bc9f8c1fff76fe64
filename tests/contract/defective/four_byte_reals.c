#define MODULE .real_bytes = 4
#include "tiny.h"
