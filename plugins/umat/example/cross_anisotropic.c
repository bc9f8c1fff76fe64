/* A UMAT in C: cross-anisotropic elasticity (transverse isotropy) with the axis of symmetry along 2, which is
 * vertical in an axisymmetric scene. PROPS: E_h, E_v, nu_hh, nu_vh (horizontal strain for vertical stress),
 * G_vh. */
#include "../umat.h"

void umat_(UMAT_ARGUMENTS) {
    const double e_h = props[0], e_v = props[1], nu_hh = props[2], nu_vh = props[3], g_vh = props[4];
    if (*nprops != 5 || !(e_h > 0.0 && e_v > 0.0 && g_vh > 0.0)) {
        stress[0] = 0.0 / 0.0; /* no result: the run ends and names the point */
        return;
    }
    const double n = e_h / e_v, m = 1.0 - nu_hh - 2.0 * n * nu_vh * nu_vh; /* positive for a stable soil */
    const double a = e_h / ((1.0 + nu_hh) * m);

    for (int i = 0; i < 36; ++i)
        ddsdde[i] = 0.0;
    ddsdde[0] = ddsdde[14] = a * (1.0 - n * nu_vh * nu_vh); /* 11 and 33 */
    ddsdde[12] = ddsdde[2] = a * (nu_hh + n * nu_vh * nu_vh);
    ddsdde[7] = e_v * (1.0 - nu_hh) / m; /* 22 */
    ddsdde[1] = ddsdde[6] = ddsdde[8] = ddsdde[13] = e_h * nu_vh / m;
    ddsdde[21] = ddsdde[35] = g_vh;                 /* 12 and 23 */
    ddsdde[28] = 0.5 * e_h / (1.0 + nu_hh);         /* 13 */

    for (int j = 0; j < *ntens; ++j)
        for (int i = 0; i < *ntens; ++i)
            stress[i] += ddsdde[i + 6 * j] * dstran[j];
}
