#include "one_point.hpp"

namespace {

constexpr double E = 15e6, nu = 0.25, su = 50e3, G = E / (2 * (1 + nu)); // Pa
const std::vector<double> clay = {E, nu, su};

void is_elastic_below_the_strength() {
    OnePoint p(clay);
    expect(p.strain({0, 0, 0, 0.9 * su / (2 * G), 0, 0}), GAULT_OK, 0, "status of update()");
    expect(p.stress[3], 0.9 * su, 1e-9 * su, "shear stress below the strength");
    expect(p.state[0], 0, 0, "plastic strain below the strength");
}

void bears_its_strength_and_no_more() {
    OnePoint p(clay);
    expect(p.strain({0, 0, 0, 3 * su / (2 * G), 0, 0}), GAULT_OK, 0, "status of update()");
    expect(p.stress[3], su, 1e-9 * su, "shear stress beyond the strength");
    // gamma = 3 su / G, of which su / G is elastic; the equivalent strain is gamma / sqrt(3)
    expect(p.state[0], 2 * su / G / std::sqrt(3.0), 1e-12, "plastic strain in pure shear");
}

void never_yields_under_pressure() {
    OnePoint p(clay);
    expect(p.strain({-0.1, -0.1, -0.1, 0, 0, 0}), GAULT_OK, 0, "status of update()");
    expect(p.stress[0], -0.1 * E / (1 - 2 * nu), 1e-9 * E, "pressure"); // 3 K e
    expect(p.state[0], 0, 0, "plastic strain under pressure");
}

void refuses_a_strength_that_no_soil_has() {
    expect(OnePoint::refused({E, nu, 2 * G}) == "undrained_strength", true, 0, "the parameter is named");
}

} // namespace

int main() {
    is_elastic_below_the_strength();
    bears_its_strength_and_no_more();
    never_yields_under_pressure();
    refuses_a_strength_that_no_soil_has();
    std::puts("new_material: all right");
}
