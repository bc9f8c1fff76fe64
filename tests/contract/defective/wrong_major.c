#define ENTRY gault_module_v2
#include "tiny.h"
