#include <stddef.h>
static const char* const twice[] = {"density", "density", NULL};
#define API .inputs = twice
#include "tiny.h"
