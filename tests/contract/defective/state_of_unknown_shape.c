#define STATE .shape = (gault_shape)9
#include "tiny.h"
