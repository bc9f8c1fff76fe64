#define COMPONENT .kind = 9
#include "tiny.h"
