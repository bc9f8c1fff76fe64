/* The entry has one address in the whole process, in spite of RTLD_LOCAL: that of the file that came first.
 * This is what gcc makes of inline data and of templates' static data, unless -fno-gnu-unique or hidden
 * visibility say otherwise. */
#define NAME "unique_other"
#include "tiny.h"
__asm__(".type gault_module_v1, %gnu_unique_object");
