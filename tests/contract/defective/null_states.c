#define API .states = NULL
#include "tiny.h"
