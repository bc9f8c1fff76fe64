#include "parts.h"

#include <string.h>

static double rate(const void* self) {
    (void)self;
    return 72.0;
}

const void* extension(const char* id) {
    static const Pulse pulse = {rate};
    return strcmp(id, "pulse/1") == 0 ? &pulse : NULL;
}

gault_status because(gault_status status, gault_error* error, int32_t parameter, int64_t point,
                     const char* text) {
    error->parameter = parameter;
    error->point = point;
    snprintf(error->text, GAULT_TEXT, "%s", text);
    return status;
}

gault_status make(const gault_host* host, size_t bytes, void** self, gault_error* error) {
    if (HAS_LATER(host, gault_host) || !GAULT_HAS(host, gault_host, extension))
        return because(GAULT_FAILED, error, -1, -1, "the host is of another size");
    if (strcmp(host->name, "gault") != 0 || !*host->version ||
        (int)host->abi_minor < (int)GAULT_ABI_MINOR - 1)
        return because(GAULT_FAILED, error, -1, -1, "the host is another");
    if (host->extension(host->self, "nobody has this/1"))
        return because(GAULT_FAILED, error, -1, -1, "the host has an extension that nobody has");
    *self = calloc(1, bytes);
    return *self ? GAULT_OK : because(GAULT_FAILED, error, -1, -1, "out of memory");
}

static const gault_component* const components[] = {&elastic, &neo_hookean, &slide,   &plate,
                                                    &beyond,  &protocol,    &witness, NULL};

GAULT_EXPORT const gault_module GAULT_ENTRY = {.magic = GAULT_MAGIC,
                                               .abi_major = GAULT_ABI_MAJOR,
                                               .abi_minor = GAULT_ABI_MINOR,
                                               .size = sizeof(gault_module),
                                               WITH_LATER.needs_minor = 0,
                                               .pointer_bytes = sizeof(void*),
                                               .real_bytes = sizeof(double),
                                               .name = "in_c",
                                               .version = "1.0.0",
                                               .author = "The Gault authors",
                                               .license = "MIT",
                                               .built_with = __VERSION__,
                                               .components = components};
