// One-point physics, called through the contract as the host does it.
#include <gault/gault.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr double E = 15e6, nu = 0.25, su = 50e3, G = E / (2 * (1 + nu)); // Pa

void expect_near(double found, double expected, double tolerance, const char* what) {
    if (std::fabs(found - expected) <= tolerance) return;
    std::printf("%s: found %.17g, expected %.17g +- %g\n", what, found, expected, tolerance);
    std::exit(1);
}

void* create(double strength, gault_status expected_status) {
    const gault_component& soil = *GAULT_ENTRY.components[0];
    gault_value values[3] = {};
    const double real[] = {E, nu, strength};
    for (int i = 0; i < 3; ++i)
        values[i].real = real[i], values[i].count = 1;
    gault_host host{};
    host.size = sizeof host;
    gault_error error{};
    void* self = nullptr;
    const gault_status status = soil.create(&host, values, &self, &error);
    expect_near(status, expected_status, 0, "status of create()");
    if (status == GAULT_INVALID) expect_near(error.parameter, 2, 0, "parameter that is named");
    return self;
}

// A batch of one point; the other lanes repeat it.
struct Batch {
    alignas(64) double strain[6][GAULT_LANES] = {}, old[6][GAULT_LANES] = {}, now[6][GAULT_LANES] = {};
    alignas(64) double state[2][GAULT_LANES] = {};
    double *old_states[1] = {state[0]}, *states[1] = {state[1]}; // one array a component
    gault_points points{};

    Batch() {
        points.size = sizeof points;
        points.count = 1;
        points.padded = GAULT_LANES;
        for (int i = 0; i < 6; ++i) {
            points.strain[i] = strain[i];
            points.stress_old[i] = old[i];
            points.stress[i] = now[i];
        }
        points.state_old = old_states;
        points.state = states;
    }
    Batch(const Batch&) = delete;
    void step(const void* self, int component, double increment) {
        for (double& lane : strain[component])
            lane = increment;
        const auto& api = *static_cast<const gault_material_api*>(GAULT_ENTRY.components[0]->api);
        gault_error error{};
        expect_near(api.update(self, &points, &error), GAULT_OK, 0, "status of update()");
    }
};

void is_elastic_below_the_strength(const void* self) {
    Batch b;
    b.step(self, 3, 0.9 * su / (2 * G)); // pure shear, tensor strain xy
    expect_near(b.now[3][0], 0.9 * su, 1e-9 * su, "shear stress below the strength");
    expect_near(b.state[1][0], 0, 0, "plastic strain below the strength");
}

void bears_its_strength_and_no_more(const void* self) {
    Batch b;
    b.step(self, 3, 3 * su / (2 * G));
    expect_near(b.now[3][0], su, 1e-9 * su, "shear stress beyond the strength");
    // gamma = 3 su / G, of which su / G is elastic; the equivalent strain is gamma / sqrt(3)
    expect_near(b.state[1][0], 2 * su / G / std::sqrt(3.0), 1e-12, "plastic strain in pure shear");
}

void never_yields_under_pressure(const void* self) {
    Batch b;
    for (int i = 0; i < 2; ++i)
        for (double& lane : b.strain[i])
            lane = -0.1;
    b.step(self, 2, -0.1);
    expect_near(b.now[0][0], -0.1 * E / (1 - 2 * nu), 1e-9 * E, "pressure"); // 3 K e
    expect_near(b.state[1][0], 0, 0, "plastic strain under pressure");
}

} // namespace

int main() {
    void* self = create(su, GAULT_OK);
    is_elastic_below_the_strength(self);
    bears_its_strength_and_no_more(self);
    never_yields_under_pressure(self);
    GAULT_ENTRY.components[0]->destroy(self);
    create(2 * G, GAULT_INVALID);
    std::puts("von_mises: all right");
}
