/* Links to another plugin and has no entry of its own. */
#include <gault/gault.h>
GAULT_EXPORT const gault_module* borrowed(void);
const gault_module* borrowed(void) {
    return &GAULT_ENTRY;
}
