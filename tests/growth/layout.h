/* Compares the layout of gault.h with layout.inc, in C11 and in C++. GROWN_BY: bytes that were appended to test it. */
// No padding: a field that a later minor put into it would seem to be in an older struct, too.
#pragma GCC diagnostic error "-Wpadded"
#include <gault/gault.h>
#pragma GCC diagnostic ignored "-Wpadded"

#ifndef GROWN_BY
#define GROWN_BY 0
#endif
#ifdef __cplusplus
#define RULE static_assert
#else
#define RULE _Static_assert
#endif

// clang-format off
#define FROZEN(type, bytes) \
    RULE(sizeof(type) == bytes, #type " has " #bytes " bytes and is [frozen] within an ABI major: see sdk/ABI.md");
#define GROWS(type, bytes) \
    RULE(sizeof(type) == bytes + GROWN_BY, #type " is recorded with " #bytes " bytes: a field is only ever appended, and " \
         "recorded in tests/growth/layout.inc, and GAULT_ABI_MINOR rises: see sdk/ABI.md");
#define FIELD(type, field, offset, bytes) \
    RULE(offsetof(type, field) == offset && sizeof(((type*)0)->field) == bytes, #type "." #field " has " #bytes \
         " bytes at offset " #offset ": within an ABI major no field moves or changes: see sdk/ABI.md");
#define WIDTH(type, bytes) \
    RULE(sizeof(type) == bytes, #type " has " #bytes " bytes within an ABI major: see sdk/ABI.md");
#define VALUE(name, value) \
    RULE(name == value, #name " is " #value " in the binaries of an ABI major: see sdk/ABI.md");
#include "layout.inc"
RULE(GAULT_ABI_MAJOR == 1 && GAULT_MAGIC == 0x31544C47, "another ABI major has another entry symbol: see sdk/ABI.md");
