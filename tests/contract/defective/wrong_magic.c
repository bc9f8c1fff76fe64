#define MODULE .magic = 0x12345678
#include "tiny.h"
