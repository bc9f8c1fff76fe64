#define COMPONENT .parameters = NULL
#include "tiny.h"
