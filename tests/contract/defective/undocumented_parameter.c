#define PARAMETER .doc = ""
#include "tiny.h"
