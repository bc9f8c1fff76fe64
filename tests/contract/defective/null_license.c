#define MODULE .license = NULL
#include "tiny.h"
