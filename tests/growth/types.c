/* A plugin whose debug information holds every struct of the contract, for abidiff. */
#include "tests/contract/defective/tiny.h"

#define FROZEN(type, bytes) GAULT_EXPORT const type* a_##type;
#define GROWS(type, bytes) GAULT_EXPORT const type* a_##type;
#define FIELD(type, field, offset, bytes)
#define WIDTH(type, bytes)
#define VALUE(name, value)
#include "layout.inc"
