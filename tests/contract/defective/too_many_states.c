#define API .states = many, .state_count = 9
#include <gault/gault.h>
#define TENSOR(letter)                                                                                       \
    { .name = letter, .unit = "1", .doc = "A tensor.", .shape = GAULT_SYMMETRIC }
static const gault_state many[] = {TENSOR("a"), TENSOR("b"), TENSOR("c"), TENSOR("d"), TENSOR("e"),
                                   TENSOR("f"), TENSOR("g"), TENSOR("h"), TENSOR("i")};
#include "tiny.h"
