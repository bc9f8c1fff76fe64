#define PARAMETER .min = NAN
#include "tiny.h"
