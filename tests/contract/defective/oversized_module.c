#define MODULE .size = 4096
#include "tiny.h"
