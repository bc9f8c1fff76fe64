#define MODULE .components = NULL
#include "tiny.h"
