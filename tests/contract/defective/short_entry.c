__attribute__((visibility("default"))) const int gault_module_v1 = 0x31544C47;
