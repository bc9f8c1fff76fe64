// What the binary contract costs: the same kernel on the same batch, called through a loaded plugin, with a
// gault_points made anew for the call as the host makes it, over called directly. In turns; "ratio" is that of the
// medians, "direct" and "contract" are times of a point.
#include "tests/verification/plugin_fixture.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

using Kernel = gault_status(const void* self, gault_points* points, gault_error* error) noexcept;
Kernel linear_elastic_v3, linear_elastic_v4, mohr_coulomb_v3, mohr_coulomb_v4; // direct.cpp

namespace {

using plugin_test::Columns;
using plugin_test::Component;

constexpr double degree = plugin_test::degree;

// At yield in Mohr-Coulomb: radial stress largest, hoop stress smallest, and an increment that goes on.
class Points {
  public:
    explicit Points(int64_t count) : count_(count) {
        for (int c = 0; c < 6; ++c)
            for (Columns* columns : {&strain_, &old_, &now_})
                columns->emplace_back(count);
        for (int k = 0; k < 4; ++k)
            more_.emplace_back(count);
        state_old_ = more_[0].data(), state_ = more_[1].data();
        for (int64_t i = 0; i < count; ++i) {
            const double radial = -400e3 * (1.0 + 0.5 * std::sin(static_cast<double>(i)));
            old_[0][i] = radial, old_[1][i] = 0.4 * radial, old_[2][i] = radial / 6.79 + 0.76e3;
            old_[3][i] = 0.01 * radial;
            strain_[0][i] = -1e-5, strain_[2][i] = 1e-5, strain_[3][i] = 1e-6;
        }
    }
    gault_points batch() {
        gault_points p{};
        p.size = sizeof p;
        p.count = p.padded = count_;
        p.time = p.dt = 1.0;
        for (int c = 0; c < 6; ++c) {
            p.strain[c] = strain_[c].data();
            p.stress_old[c] = old_[c].data();
            p.stress[c] = now_[c].data();
        }
        p.state_old = &state_old_;
        p.state = &state_;
        p.modulus = more_[2].data();
        p.shear_modulus = more_[3].data();
        return p;
    }

  private:
    int64_t count_;
    Columns strain_, old_, now_, more_;
    double *state_old_, *state_;
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

template <class Call>
double seconds(int calls, Call call) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < calls; ++k)
        call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls;
}

template <Kernel* direct>
void compare(benchmark::State& state, const Component& component) {
    const int64_t count = state.range(0);
    const int calls = static_cast<int>(65536 / count);
    Points points(count);
    gault_points kept = points.batch();
    gault_error error{-1, 0, -1, ""};
    const auto update = component.api<gault_material_api>().update;
    std::vector<double> without, with;
    const auto time_direct = [&] {
        without.push_back(seconds(calls, [&] {
            benchmark::DoNotOptimize(direct(component.self(), &kept, &error));
            benchmark::ClobberMemory();
        }));
    };
    const auto time_contract = [&] {
        with.push_back(seconds(calls, [&] {
            gault_points p = points.batch();
            error.parameter = -1, error.point = -1, error.text[0] = '\0';
            benchmark::DoNotOptimize(update(component.self(), &p, &error));
            benchmark::ClobberMemory();
        }));
    };
    for (auto _ : state) {
        time_direct();
        time_contract();
        time_contract();
        time_direct();
    }
    state.counters["direct"] = median(without) / static_cast<double>(count);
    state.counters["contract"] = median(with) / static_cast<double>(count);
    state.counters["ratio"] = median(with) / median(without);
}

template <Kernel* direct>
void add(const char* name, const Component& component) {
    benchmark::RegisterBenchmark(name, [&component](benchmark::State& s) { compare<direct>(s, component); })
        ->Arg(64)
        ->Arg(512)
        ->Arg(4096)
        ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int count, char** arguments) {
    const bool v4 = __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    const std::string variant = v4 ? "glibc-hwcaps/x86-64-v4/" : "glibc-hwcaps/x86-64-v3/";
    const Component elastic("linear_elastic", GAULT_MATERIAL, "linear_elastic",
                            {{"young_modulus", 100e6}, {"poisson_ratio", 0.25}}, variant);
    const Component plastic("mohr_coulomb", GAULT_MATERIAL, "mohr_coulomb",
                            {{"young_modulus", 100e6},
                             {"poisson_ratio", 0.25},
                             {"cohesion", 1e3},
                             {"friction_angle", 48 * degree},
                             {"dilation_angle", 16.5 * degree}},
                            variant);
    if (v4) {
        add<linear_elastic_v4>("linear_elastic", elastic);
        add<mohr_coulomb_v4>("mohr_coulomb", plastic);
    } else {
        add<linear_elastic_v3>("linear_elastic", elastic);
        add<mohr_coulomb_v3>("mohr_coulomb", plastic);
    }
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
}
