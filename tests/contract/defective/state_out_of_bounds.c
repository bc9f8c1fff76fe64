#define STATE .initial = -1.0
#include "tiny.h"
