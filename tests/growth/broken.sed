# Today's gault.h with two rules broken: fields that move, and a field with padding behind it.
s/double fallback, min, max;/double min, max, fallback;/
s/^\} gault_step;/    uint32_t narrow;\n&/
