/* A plugin in C that uses everything of SDK 1.0, compiled against the headers of 1.0, which are kept beside it, and
 * against headers one minor ahead of this host's, whose growing structs have one field more: LATER is defined then. */
#include <gault/gault.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef LATER
#define WITH_LATER .later = "unknown to the host",
#define HAS_LATER(ptr, type) GAULT_HAS(ptr, type, later)
#else
#define WITH_LATER
#define HAS_LATER(ptr, type) 0
#endif

#define PARAMETER(...)                                                                                       \
    { .size = sizeof(gault_parameter), WITH_LATER.symbol = "", __VA_ARGS__ }
#define COMPONENT(component_kind, component_name, about, list, functions, make)                              \
    {                                                                                                        \
        .size = sizeof(gault_component), WITH_LATER.kind = component_kind, .name = component_name,           \
        .version = "1.0.0", .doc = about, .reference = "", .parameters = list, .api = functions,             \
        .create = make, .destroy = free, .extension = extension                                              \
    }

extern const gault_component elastic, neo_hookean, slide, plate, beyond, protocol, witness;

/* What "pulse/1" names. */
typedef struct Pulse {
    double (*rate)(const void* self);
} Pulse;

const void* extension(const char* id);

/* `status`, with a reason. */
gault_status because(gault_status status, gault_error* error, int32_t parameter, int64_t point,
                     const char* text);

/* Allocates `bytes` for an instance, once the host has shown what 1.0 says of it. */
gault_status make(const gault_host* host, size_t bytes, void** self, gault_error* error);
