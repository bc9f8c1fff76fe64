#define API .size = 8
#include "tiny.h"
