// One call of a UMAT: its arguments, under the names that Abaqus gives them, and what is wrong with its answer.
#pragma once
#include "library.hpp"
#include "umat.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace umat {

extern "C" typedef void Function(UMAT_ARGUMENTS);

// Component k of Abaqus's 11 22 33 12 13 23 among the contract's xx yy zz xy yz zx, and the reverse.
constexpr int place[6] = {0, 1, 2, 3, 5, 4};
constexpr double engineering[6] = {1.0, 1.0, 1.0, 2.0, 2.0, 2.0}; // shear strain over tensor shear

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double shortest = 1e-9; // s; a UMAT may divide by DTIME

struct Routine { // and what it is always told
    Function* function;
    std::array<char, 80> cmname;
    std::vector<double> props;
    int nprops, nstatv;
};

class Call {
  public:
    double stress[6], stran[6], dstran[6], ddsdde[36], time, dtime, celent, pnewdt;
    std::vector<double> statev; // and a margin

    explicit Call(const Routine& routine)
        : statev(static_cast<std::size_t>(routine.nstatv) + margin, nan), routine_(&routine) {}

    // Nothing, or why there is no result. A PNEWDT below 1 is no failure: nothing else then holds.
    std::string run() {
        if (!call()) return "stopped by calling XIT";
        for (std::size_t i = statev.size() - margin; i < statev.size(); ++i)
            if (std::memcmp(&statev[i], &nan, sizeof nan) != 0)
                return "wrote to STATEV(" + std::to_string(i + 1) + "), which is beyond 'statev'";
        if (wants_a_shorter_step()) return "";
        for (std::size_t i = 0; i < 6; ++i)
            if (!std::isfinite(stress[i]))
                return "returned a stress that is not finite; what it is not given is NaN: further "
                       "properties "
                       "and state variables, and the deformation gradient";
        for (std::size_t i = 0; i < statev.size() - margin; ++i)
            if (!std::isfinite(statev[i]))
                return "returned a STATEV(" + std::to_string(i + 1) + ") that is not finite";
        return "";
    }
    bool wants_a_shorter_step() const { return !(pnewdt >= 1.0); }
    bool has_finite_tangent() const {
        return std::all_of(ddsdde, ddsdde + 36, [](double x) { return std::isfinite(x); });
    }

    // The end of this call becomes the start of the next, which takes no time.
    void advance() {
        for (int k = 0; k < 6; ++k)
            stran[k] += dstran[k];
        time += dtime;
        dtime = 0.0;
    }

  private:
    static constexpr std::size_t margin =
        16; // behind arrays, where reading and writing beyond them is noticed

    // Everything is a copy: a UMAT that writes to its input spoils nothing.
    bool call() {
        std::vector<double> props(routine_->props.size() + margin, nan);
        std::copy(routine_->props.begin(), routine_->props.end(), props.begin());
        std::array<char, 80> cmname = routine_->cmname;
        std::fill(std::begin(ddsdde), std::end(ddsdde), 0.0);
        pnewdt = 1e10;
        double times[2] = {time, time}, length = std::max(dtime, shortest);
        double sse = 0.0, spd = 0.0, scd = 0.0, rpl = 0.0, ddsddt[6] = {}, drplde[6] = {}, drpldt = 0.0;
        double temp = 0.0, dtemp = 0.0, predef[margin] = {}, dpred[margin] = {}, coords[3] = {};
        double drot[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, dfgrd0[9], dfgrd1[9];
        std::fill_n(dfgrd0, 9, nan);
        std::fill_n(dfgrd1, 9, nan);
        double strain[6], increment[6], size = celent;
        std::copy_n(stran, 6, strain);
        std::copy_n(dstran, 6, increment);
        int ndi = 3, nshr = 3, ntens = 6, nstatv = routine_->nstatv, nprops = routine_->nprops;
        int noel = 1, npt = 1, layer = 1, kspt = 1, jstep[4] = {1, 1, 1, 0}, kinc = time > 0.0 ? 2 : 1;
        return runs_to_its_end([&] {
            routine_->function(stress, statev.data(), ddsdde, &sse, &spd, &scd, &rpl, ddsddt, drplde, &drpldt,
                               strain, increment, times, &length, &temp, &dtemp, predef, dpred, cmname.data(),
                               &ndi, &nshr, &ntens, &nstatv, props.data(), &nprops, coords, drot, &pnewdt,
                               &size, dfgrd0, dfgrd1, &noel, &npt, &layer, &kspt, jstep, &kinc,
                               cmname.size());
        });
    }

    const Routine* routine_;
};

} // namespace umat
