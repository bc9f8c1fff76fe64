#define COMPONENT .version = ""
#include "tiny.h"
