static const char* const words[] = {"dry", "wet", 0};
#define PARAMETER .flags = 0, .type = GAULT_CHOICE, .choices = words, .fallback = 2
#include "tiny.h"
