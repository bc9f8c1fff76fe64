// Cost of the Mohr-Coulomb update per material point: batches of 512 points in cache, one benchmark a variant
// of the plugin and a mix of states. Axisymmetric unless said. Counter "point" is the time of one update.
#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <gault/gault.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr int64_t points = 512;

const gault_component& load(const std::string& variant) {
    const std::string path =
        std::string(GAULT_BINARY_DIR "/lib/gault/plugins/") + variant + "mohr_coulomb.so";
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        std::fprintf(stderr, "%s\n", dlerror());
        std::exit(1);
    }
    return *static_cast<const gault_module*>(dlsym(library, GAULT_ENTRY_SYMBOL))->components[0];
}

struct Arrays {
    std::vector<double*> all;
    double* add(double value) {
        double* a = static_cast<double*>(std::aligned_alloc(64, points * sizeof(double)));
        std::fill_n(a, points, value);
        all.push_back(a);
        return a;
    }
    ~Arrays() {
        for (double* a : all)
            std::free(a);
    }
};

enum Mix { elastic, cavity, edges, cut_off, oblique, softening };

// Fahey's soil (E 100 MPa, nu 0.25, c 1 kPa, phi 48, psi 16.5 deg); softening: the states of `cavity`.
void update(benchmark::State& state, const gault_component& component, Mix mix, bool tangent) {
    const double degree = M_PI / 180.0;
    std::array<gault_value, 11> values{};
    const double given[] = {100e6, 0.25,        1e3, 48 * degree, 16.5 * degree, 500.0, // as declared
                            0.5e3, 36 * degree, 0.0, 0.05,        0.01};
    for (int i = 0; i < 11; ++i) {
        values[i].real = given[i];
        values[i].count = i < 5 || (i == 5 ? mix == cut_off : mix == softening);
    }
    void* self = nullptr;
    gault_error error{};
    if (component.create(nullptr, values.data(), &self, &error) != GAULT_OK) std::exit(1);

    Arrays arrays;
    gault_points batch{};
    batch.size = sizeof batch;
    batch.count = batch.padded = points;
    double *strain[6], *stress[6];
    for (int c = 0; c < 6; ++c) {
        batch.strain[c] = strain[c] = arrays.add(0.0);
        batch.stress_old[c] = stress[c] = arrays.add(0.0);
        batch.stress[c] = arrays.add(0.0);
    }
    double *const old_state = arrays.add(0.0), *const state_now = arrays.add(0.0);
    const double* const cell = arrays.add(0.01);
    batch.input = &cell;
    batch.state_old = &old_state;
    batch.state = &state_now;
    batch.modulus = arrays.add(0.0);
    batch.shear_modulus = arrays.add(0.0);
    if (tangent)
        for (double*& t : batch.tangent)
            t = arrays.add(0.0);

    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int64_t i = 0; i < points; ++i) { // at yield: radial stress largest, hoop smallest in compression
        const double radial = -400e3 * (1.0 + 0.5 * unit(random)), hoop = radial / 6.79 + 0.76e3;
        const double axial = 0.4 * radial;
        stress[0][i] = radial;
        stress[1][i] = mix == edges && i % 2 ? hoop : axial;
        stress[2][i] = mix == elastic ? 0.8 * radial : hoop;
        stress[3][i] = 0.02 * radial * unit(random);
        strain[0][i] = -1e-5 * (1.1 + unit(random));
        strain[2][i] = mix == elastic ? 0.0 : 1e-5 * (1.1 + unit(random));
        strain[3][i] = 1e-6 * unit(random);
        if (mix == cut_off) strain[1][i] = strain[2][i] = 1e-3 * (1.1 + unit(random));
        if (mix == oblique) strain[4][i] = 1e-5 * unit(random);
    }
    const auto& api = *static_cast<const gault_material_api*>(component.api);
    api.update(self, &batch, &error);
    const int64_t returned = points - std::count(batch.state[0], batch.state[0] + points, 0.0);
    for (auto _ : state) {
        api.update(self, &batch, &error);
        benchmark::ClobberMemory();
    }
    state.counters["returned"] = double(returned) / points;
    state.counters["point"] = benchmark::Counter(double(points) * double(state.iterations()),
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    component.destroy(self);
}

} // namespace

int main(int count, char** arguments) {
    struct Variant {
        const char *name, *folder;
        bool runs;
    };
    const Variant variants[] = {{"v4", "glibc-hwcaps/x86-64-v4/",
                                 __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")},
                                {"v3", "glibc-hwcaps/x86-64-v3/", __builtin_cpu_supports("avx2") != 0},
                                {"baseline", "", true}};
    const std::pair<const char*, Mix> mixes[] = {{"elastic", elastic}, {"cavity", cavity},
                                                 {"edges", edges},     {"cut_off", cut_off},
                                                 {"oblique", oblique}, {"softening", softening}};
    for (const Variant& v : variants) {
        if (!v.runs) continue;
        const gault_component& component = load(v.folder);
        for (const auto& [name, mix] : mixes)
            for (const bool tangent : {false, true})
                benchmark::RegisterBenchmark(
                    (std::string("mohr_coulomb/") + name + (tangent ? "+tangent/" : "/") + v.name).c_str(),
                    [&component, mix = mix, tangent](benchmark::State& s) {
                        update(s, component, mix, tangent);
                    });
    }
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
}
