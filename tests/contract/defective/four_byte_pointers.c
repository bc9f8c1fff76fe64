#define MODULE .pointer_bytes = 4
#include "tiny.h"
