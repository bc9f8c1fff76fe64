#define COMPONENT .create = NULL
#include "tiny.h"
