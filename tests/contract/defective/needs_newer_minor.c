#define MODULE .needs_minor = 3, .abi_minor = 3
#include "tiny.h"
