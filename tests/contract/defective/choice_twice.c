static const char* const words[] = {"dry", "dry", 0};
#define PARAMETER .type = GAULT_CHOICE, .choices = words
#include "tiny.h"
