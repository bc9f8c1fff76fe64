#define COMPONENT .destroy = NULL
#include "tiny.h"
