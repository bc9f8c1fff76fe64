#define MODULE .components = components + 1
#include "tiny.h"
