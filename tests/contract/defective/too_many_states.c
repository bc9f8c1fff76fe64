#define API .states = many, .state_count = 700
#include <gault/gault.h>
#define TENSOR(number)                                                                                       \
    { .name = "t" #number, .unit = "1", .doc = "A tensor.", .shape = GAULT_SYMMETRIC }
#define TEN(n)                                                                                               \
    TENSOR(n##0), TENSOR(n##1), TENSOR(n##2), TENSOR(n##3), TENSOR(n##4), TENSOR(n##5), TENSOR(n##6),        \
        TENSOR(n##7), TENSOR(n##8), TENSOR(n##9)
#define HUNDRED(n)                                                                                           \
    TEN(n##0), TEN(n##1), TEN(n##2), TEN(n##3), TEN(n##4), TEN(n##5), TEN(n##6), TEN(n##7), TEN(n##8), TEN(n##9)
static const gault_state many[] = {HUNDRED(1), HUNDRED(2), HUNDRED(3), HUNDRED(4),
                                   HUNDRED(5), HUNDRED(6), HUNDRED(7)};
#include "tiny.h"
