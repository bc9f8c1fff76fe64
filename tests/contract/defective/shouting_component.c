#define COMPONENT .name = "Tiny Soil"
#include "tiny.h"
