/* Isotropic elasticity, PROPS(1) lambda and PROPS(2) G, that notes in STATEV what it was told. */
#include "../umat.h"

void umat_(UMAT_ARGUMENTS) {
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            ddsdde[i + 6 * j] = i < 3 && j < 3 ? props[0] + 2.0 * props[1] * (i == j) : props[1] * (i == j);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            stress[i] += ddsdde[i + 6 * j] * dstran[j];

    int blanks = 0, n = 0;
    for (size_t i = 0; i < cmname_length; ++i)
        blanks += cmname[i] == ' ';
    const double told[] = {*ndi,    *nshr,   *ntens,      *nstatv, *nprops,  time[0],      time[1],
                           *dtime,  *temp,   *dtemp,      *kinc,   jstep[0], *noel,        *npt,
                           *layer,  *kspt,   *celent,     *pnewdt, (double)cmname_length, blanks, cmname[0],
                           drot[0], drot[4], drot[8],     drot[1], coords[0], predef[0],   dpred[0],
                           dfgrd0[0] != dfgrd0[0],        dfgrd1[8] != dfgrd1[8]};
    for (; n < 30; ++n)
        statev[n] = told[n];
    for (int i = 0; i < 6; ++i)
        statev[n++] = stran[i];
    for (int i = 0; i < 6; ++i)
        statev[n++] = dstran[i];
    for (; n < *nstatv; ++n)
        statev[n] += n + 1; /* what is not overwritten shows what came in */

    /* Arguments are the callee's own to spoil. */
    for (int i = 0; i < 6; ++i)
        stran[i] = dstran[i] = -1.0;
    props[0] = props[1] = *celent = *dtime = time[0] = time[1] = -1.0;
    cmname[0] = '?';
    *nstatv = *nprops = *kinc = -1;
}
