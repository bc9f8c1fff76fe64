#define API .update = NULL
#include "tiny.h"
