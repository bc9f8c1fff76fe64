#define MODULE .name = ""
#include "tiny.h"
