#define COMPONENT .doc = NULL
#include "tiny.h"
