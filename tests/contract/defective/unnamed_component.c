#define COMPONENT .name = NULL
#include "tiny.h"
