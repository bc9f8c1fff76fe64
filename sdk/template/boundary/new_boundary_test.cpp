#include <gault/gault.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr double k = 2e6; // Pa/m
using Vector = double[3];

void expect(double found, double expected, double tolerance, const char* what) {
    if (std::fabs(found - expected) <= tolerance) return;
    std::printf("%s: found %.17g, expected %.17g +- %g\n", what, found, expected, tolerance);
    std::exit(1);
}

// One facet without a host: the plugin is called through the contract as a host calls it.
class OneFacet {
  public:
    Vector traction{}, slope[3]{}; // Pa, Pa/m

    OneFacet() {
        gault_value stiffness{};
        stiffness.real = k, stiffness.count = 1;
        gault_host host{};
        host.size = sizeof host;
        gault_error error{};
        expect(boundary().create(&host, &stiffness, &self_, &error), GAULT_OK, 0, "status of create()");
    }
    ~OneFacet() { boundary().destroy(self_); }
    OneFacet(const OneFacet&) = delete;
    OneFacet& operator=(const OneFacet&) = delete;

    void load(const Vector& normal, const Vector& displacement, const Vector& initial_traction) {
        struct alignas(64) Lanes {
            double value[GAULT_LANES];
        };
        Lanes n[3]{}, u[3]{}, t0[3]{}, zero{}, pressure{}, t[3]{}, s[9]{};
        gault_facets facets{};
        facets.size = sizeof facets, facets.count = 1, facets.padded = GAULT_LANES, facets.dt = 1;
        for (int i = 0; i < 3; ++i) {
            n[i].value[0] = normal[i], u[i].value[0] = displacement[i], t0[i].value[0] = initial_traction[i];
            facets.position[i] = facets.velocity[i] = zero.value;
            facets.normal[i] = n[i].value, facets.displacement[i] = u[i].value;
            facets.initial_traction[i] = t0[i].value, facets.traction[i] = t[i].value;
        }
        for (int i = 0; i < 9; ++i)
            facets.slope[i] = s[i].value;
        facets.impedance[0] = facets.impedance[1] = facets.shear_modulus = zero.value;
        facets.pressure = pressure.value;
        gault_error error{};
        const auto& api = *static_cast<const gault_boundary_api*>(boundary().api);
        expect(api.load(self_, &facets, &error), GAULT_OK, 0, "status of load()");
        for (int i = 0; i < 3; ++i) {
            traction[i] = t[i].value[0];
            for (int j = 0; j < 3; ++j)
                slope[i][j] = s[3 * i + j].value[0];
        }
    }

  private:
    static const gault_component& boundary() { return *GAULT_ENTRY.components[0]; }
    void* self_ = nullptr;
};

void balances_the_initial_stress_at_rest() {
    OneFacet f;
    f.load({1, 0, 0}, {0, 0, 0}, {-9e4, 2e4, 0});
    expect(f.traction[0], -9e4, 0, "normal traction at rest");
    expect(f.traction[1], 2e4, 0, "tangential traction at rest");
}

void pushes_back_along_the_normal() {
    OneFacet f;
    f.load({0.6, 0.8, 0}, {2e-3, 0, 5e-3}, {0, 0, 0}); // 1.2 mm of it along the normal
    expect(f.traction[0], -0.6 * k * 1.2e-3, 1e-9, "traction along x");
    expect(f.traction[1], -0.8 * k * 1.2e-3, 1e-9, "traction along y");
    expect(f.traction[2], 0, 0, "traction along z");
}

void tells_an_implicit_solver_its_slope() {
    OneFacet f;
    const double shift = 1e-3;
    for (int j = 0; j < 3; ++j) {
        Vector there{};
        there[j] = shift;
        f.load({0.6, 0.8, 0}, there, {0, 0, 0});
        for (int i = 0; i < 3; ++i)
            expect(f.slope[i][j], -f.traction[i] / shift, 1e-9 * k, "slope");
    }
}

} // namespace

int main() {
    balances_the_initial_stress_at_rest();
    pushes_back_along_the_normal();
    tells_an_implicit_solver_its_slope();
    std::puts("new_boundary: all right");
}
