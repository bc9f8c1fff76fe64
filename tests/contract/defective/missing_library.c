int from_a_missing_library(void);
int (*wanted)(void) = from_a_missing_library;
#include "tiny.h"
