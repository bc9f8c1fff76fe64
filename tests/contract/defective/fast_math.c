/* Linked with -ffast-math. */
#include "tiny.h"
