/* Isotropic elasticity, PROPS(1) lambda and PROPS(2) G, in UMATs each of which does one thing that is not
 * nice. */
#include "../umat.h"

#define ARGUMENTS                                                                                            \
    stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp,    \
        dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, \
        dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc, cmname_length

int sched_yield(void);
void xit_(void);
void stdb_abqerr_(const int*, const char*, const int*, const double*, const char*, size_t, size_t);

void umat_(UMAT_ARGUMENTS) {
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            ddsdde[i + 6 * j] = i < 3 && j < 3 ? props[0] + 2.0 * props[1] * (i == j) : props[1] * (i == j);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            stress[i] += ddsdde[i + 6 * j] * dstran[j];
}

static int exceeds(const double* dstran, double limit) {
    for (int i = 0; i < 6; ++i)
        if (dstran[i] > limit || dstran[i] < -limit) return 1;
    return 0;
}

/* Wants increments below PROPS(3), and leaves stress alone otherwise. */
void cautious_(UMAT_ARGUMENTS) {
    if (exceeds(dstran, props[2]))
        *pnewdt = 0.25;
    else
        umat_(ARGUMENTS);
}
/* Wants a shorter step whatever it gets, once there is any strain. */
void never_content_(UMAT_ARGUMENTS) {
    umat_(ARGUMENTS);
    if (exceeds(dstran, 1e-8)) *pnewdt = 0.5;
}
void not_finite_(UMAT_ARGUMENTS) { /* in tension */
    umat_(ARGUMENTS);
    if (dstran[0] > 1e-8) stress[0] = 0.0 / 0.0;
}
void not_finite_state_(UMAT_ARGUMENTS) {
    umat_(ARGUMENTS);
    if (dstran[0] > 1e-8) statev[1] = 1.0 / 0.0;
}
void not_finite_tangent_(UMAT_ARGUMENTS) {
    umat_(ARGUMENTS);
    if (dstran[0] > 1e-8) ddsdde[7] = 0.0 / 0.0;
}
void without_tangent_(UMAT_ARGUMENTS) {
    umat_(ARGUMENTS);
    for (int i = 0; i < 36; ++i)
        ddsdde[i] = 0.0;
}
void oversteps_(UMAT_ARGUMENTS) {
    umat_(ARGUMENTS);
    statev[*nstatv] = 1.0;
}
void wants_more_properties_(UMAT_ARGUMENTS) {
    umat_(ARGUMENTS);
    stress[1] += props[*nprops] * dstran[1];
}
void wants_the_gradient_(UMAT_ARGUMENTS) {
    stress[0] = props[1] * (dfgrd1[0] - 1.0);
}
void total_(UMAT_ARGUMENTS) { /* stress from total strain */
    for (int i = 0; i < 6; ++i) {
        stress[i] = 0.0;
        dstran[i] += stran[i];
    }
    umat_(ARGUMENTS);
}
void exits_(UMAT_ARGUMENTS) { /* from a caller of its own, as most do */
    umat_(ARGUMENTS);
    if (dstran[0] > 1e-8) {
        xit_();
        *(volatile double*)0 = 0.0; /* nothing runs after XIT */
    }
}
void reports_(UMAT_ARGUMENTS) {
    const int lop = dstran[0] > 1e-8 ? -3 : 1, integers[] = {7, 11};
    const double reals[] = {dstran[0]};
    umat_(ARGUMENTS);
    if (exceeds(dstran, 1e-8))
        stdb_abqerr_(&lop, "step %I of %I: %R in %S  ", integers, reals, "SAND    ", 25, 8);
}

/* STATEV(1): the most threads that were in here at a time. */
void crowded_(UMAT_ARGUMENTS) {
    static int inside, most;
    const int now = __atomic_add_fetch(&inside, 1, __ATOMIC_SEQ_CST);
    for (int seen = __atomic_load_n(&most, __ATOMIC_SEQ_CST); seen < now;)
        if (__atomic_compare_exchange_n(&most, &seen, now, 0, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST)) break;
    for (int turn = 0; turn < 20; ++turn) /* the others come in, if they may */
        sched_yield();
    umat_(ARGUMENTS);
    statev[0] = __atomic_load_n(&most, __ATOMIC_SEQ_CST);
    __atomic_sub_fetch(&inside, 1, __ATOMIC_SEQ_CST);
}
