#define MODULE .abi_major = 2
#include "tiny.h"
