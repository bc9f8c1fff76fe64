/* Linear elasticity with 21 constants: the lower triangle of DDSDDE, row by row. */
#include "../umat.h"

void umat_(UMAT_ARGUMENTS) {
    for (int i = 0, k = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j, ++k)
            ddsdde[i + 6 * j] = ddsdde[j + 6 * i] = props[k];
    for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 6; ++i)
            stress[i] += ddsdde[i + 6 * j] * dstran[j];
}
