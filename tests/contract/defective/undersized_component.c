#define COMPONENT .size = 16
#include "tiny.h"
