#define STATE .unit = NULL
#include "tiny.h"
