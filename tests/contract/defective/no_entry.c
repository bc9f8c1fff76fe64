/* A library, and no plugin. */
__attribute__((visibility("default"))) int gault_module = 1;
