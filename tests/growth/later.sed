# Today's gault.h, one minor ahead: every struct that grows has a field more.
s/^(#define GAULT_ABI_MINOR) (.*)/\1 (\2 + 1u)/
/^typedef struct.*\[grows\]/,/^\} gault_/s/^\} gault_/    const void *later;\n&/
