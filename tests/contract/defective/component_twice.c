#define COMPONENTS &soil, &soil, NULL
#include "tiny.h"
