/* Needs the minor of the SDK that it is built with, which is ahead of this host's. */
#define MODULE .needs_minor = GAULT_ABI_MINOR
#include "tests/contract/defective/tiny.h"
