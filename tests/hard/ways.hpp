// A scene in both frames and with both solvers.
#pragma once
#include "tests/hard/hard_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace gault::core::test {

struct Way {
    const char *frame, *solver;
    bool has_inertia() const { return std::string(solver) == "explicit"; }
    std::string name() const { return std::string(frame) + " " + solver; }
    friend void PrintTo(const Way& way, std::ostream* out) { *out << way.name(); }
};

class EveryWay : public testing::TestWithParam<Way> {
  protected:
    std::vector<Override> with(std::vector<Override> more = {}) const {
        more.push_back({"model.frame", GetParam().frame});
        more.push_back({"model.solver", GetParam().solver});
        return more;
    }
    bool has_inertia() const { return GetParam().has_inertia(); }
    bool updated() const { return std::string(GetParam().frame) == "updated"; }

    void expect_near(const std::string& what, double measured, double expected, double relative) const {
        std::printf("%-22s %-34s %12.6g, expected %12.6g (%+.4f %%)\n", GetParam().name().c_str(),
                    what.c_str(), measured, expected, 100.0 * (measured / expected - 1.0));
        EXPECT_NEAR(measured, expected, relative * std::abs(expected)) << what;
    }
    void expect_below(const std::string& what, double measured, double bound) const {
        std::printf("%-22s %-34s %12.4g, at most %g\n", GetParam().name().c_str(), what.c_str(), measured,
                    bound);
        EXPECT_LE(measured, bound) << what;
    }
};

inline auto every_way() {
    return testing::Values(Way{"total", "quasi_static"}, Way{"updated", "quasi_static"},
                           Way{"total", "explicit"}, Way{"updated", "explicit"});
}
inline std::string name_of_way(const testing::TestParamInfo<Way>& info) {
    return std::string(info.param.frame[0] == 't' ? "Total" : "Updated") +
           (info.param.has_inertia() ? "Explicit" : "QuasiStatic");
}

// A cavity opened, or closed, from one of these strains to the next. The wall starts gently; it comes to rest at each strain
// or, where it `passes`, only where it turns back.
inline Override moved_to(const std::vector<double>& strains, const char* rate, bool passes,
                         bool has_inertia) {
    std::string phases;
    for (std::size_t i = 0; i < strains.size(); ++i) {
        const bool opens = strains[i] > (i > 0 ? strains[i - 1] : 0.0);
        if (passes && i + 1 < strains.size() && (strains[i + 1] > strains[i]) == opens) continue;
        phases += fmt::format("{}{{{}: {{until: {{cavity_strain: {:.14g}}}}}}}", phases.empty() ? "" : ", ",
                              opens ? "expand" : "unload", strains[i]);
    }
    return {"program", fmt::format("{{type: pressuremeter, on: inner, rate: {}, {}phases: [{}{}]}}", rate,
                                   has_inertia ? "ramp_strain: 0.5 %, " : "", phases,
                                   passes ? "" : ", {hold: {duration: 0 s}}")};
}

// The true pressure where the cavity strain is last this one, between rows, kPa.
inline double pressure_at_strain(const HardScene& s, double strain) {
    const auto e = s.column("cavity_strain"), p = s.column("true_pressure");
    for (std::size_t i = e.size(); i-- > 0;) {
        if (std::abs(e[i] - strain) <= 1e-9) return p[i] / 1e3;
        if (i > 0 && (e[i - 1] - strain) * (e[i] - strain) < 0.0)
            return (p[i - 1] + (p[i] - p[i - 1]) * (strain - e[i - 1]) / (e[i] - e[i - 1])) / 1e3;
    }
    return std::nan("");
}

} // namespace gault::core::test
