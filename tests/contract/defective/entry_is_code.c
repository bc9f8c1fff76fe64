__attribute__((visibility("default"))) int gault_module_v1(void);
int gault_module_v1(void) {
    return 1;
}
