#include <gault/gault.h>
static const gault_parameter* inside[];
static const gault_record_kind kind = {
    .size = sizeof kind, .name = "again", .doc = "Itself.", .parameters = inside};
static const gault_record_kind* const kinds[] = {&kind, NULL};
static const gault_parameter again = {.size = sizeof again,
                                      .type = GAULT_RECORDS,
                                      .flags = GAULT_REQUIRED,
                                      .name = "again",
                                      .symbol = "",
                                      .unit = "",
                                      .doc = "Itself.",
                                      .kinds = kinds};
static const gault_parameter* inside[] = {&again, NULL};
#define PARAMETERS &again, NULL
#include "tiny.h"
