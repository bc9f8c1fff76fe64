#define COMPONENT .api = NULL
#include "tiny.h"
