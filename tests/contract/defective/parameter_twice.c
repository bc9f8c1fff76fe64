#define PARAMETERS &stiffness, &stiffness, NULL
#include "tiny.h"
