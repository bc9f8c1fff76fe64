/* The arguments of an Abaqus/Standard UMAT as compilers on Linux pass them, for UMATs in C:
 *
 *     #include "umat.h"
 *     void umat_(UMAT_ARGUMENTS) { ... }
 *
 * Components are 11 22 33 12 13 23 with engineering shear strain; DDSDDE is by columns:
 * d stress[i] / d strain[j] is ddsdde[i + 6 * j]. */
#ifndef GAULT_UMAT_H
#define GAULT_UMAT_H

#include <stddef.h>

#define UMAT_ARGUMENTS                                                                                       \
    double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl,      \
        double *ddsddt, double *drplde, double *drpldt, double *stran, double *dstran, double *time,         \
        double *dtime, double *temp, double *dtemp, double *predef, double *dpred, char *cmname, int *ndi,   \
        int *nshr, int *ntens, int *nstatv, double *props, int *nprops, double *coords, double *drot,        \
        double *pnewdt, double *celent, double *dfgrd0, double *dfgrd1, int *noel, int *npt, int *layer,     \
        int *kspt, int *jstep, int *kinc, size_t cmname_length /* hidden in Fortran */

#endif
