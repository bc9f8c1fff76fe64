/* The entry has one address in the whole process, in spite of RTLD_LOCAL: that of the file that came first.
 * This is what gcc makes of inline data and of templates' static data, unless -fno-gnu-unique or hidden
 * visibility say otherwise. */
#define NAME "unique_other"
#define ENTRY own_module
#include "tiny.h"
__asm__(".type gault_module_v1, %gnu_unique_object\n"
        ".set gault_module_v1, own_module\n"
        ".size gault_module_v1, 72\n");
_Static_assert(sizeof(gault_module) == 72, "size of the symbol");
