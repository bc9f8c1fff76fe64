#define COMPONENT .reference = NULL
#include "tiny.h"
