#define NAME "doubled"
#include "tiny.h"
