// Free vibration of elastic bodies of revolution, started from exact velocities, against exact modes: errors of the raw
// points' displacement, velocity and stress, L2, after a little more than a period, on finer and finer grids.
#include "tests/hard/moving_body.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0, pi = std::numbers::pi;
constexpr double stiff = lame + 2.0 * shear;
constexpr double speed = 1e-6; // m/s: strains of 1e-8, so that the bodies are linear
const double c_p = std::sqrt(stiff / density), c_s = std::sqrt(shear / density);

// Displacement shape {r, z}, its stress {rr, zz, hoop, rz}, and its angular frequency.
struct Mode {
    double omega;
    std::function<std::array<double, 2>(double, double)> shape;
    std::function<std::array<double, 4>(double, double)> stress;
};

double j0(double x) {
    return std::cyl_bessel_j(0.0, x);
}
double j1(double x) {
    return std::cyl_bessel_j(1.0, x);
}
double y0(double x) {
    return std::cyl_neumann(0.0, x);
}
double y1(double x) {
    return std::cyl_neumann(1.0, x);
}

// The n-th root of f above `from`, by steps and bisection.
double root(const std::function<double(double)>& f, double from, int n) {
    const double step = 0.01;
    double x = from;
    while (f(x) * f(x + step) > 0.0 || --n > 0)
        x += step;
    double low = x, high = x + step;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (f(low) * f(middle) <= 0.0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

// Radial motion of an annulus between walls that are held, or free: u = A J1(kr) + B Y1(kr).
Mode annulus_mode(double a, double b, bool held, int n) {
    const auto wall = [held](bool second, double k,
                             double r) { // what vanishes there: u, or the radial stress
        const double u = second ? y1(k * r) : j1(k * r), zero = second ? y0(k * r) : j0(k * r);
        return held ? u : stiff * (k * zero - u / r) + lame * u / r;
    };
    const double k = root(
        [&](double x) { return (wall(0, x, a) * wall(1, x, b) - wall(1, x, a) * wall(0, x, b)) / stiff; },
        0.5, n);
    const double A = wall(1, k, a), B = -wall(0, k, a), size = std::hypot(A, B);
    const auto u = [=](double r) { return (A * j1(k * r) + B * y1(k * r)) / size; };
    const auto slope = [=](double r) { return k * (A * j0(k * r) + B * y0(k * r)) / size - u(r) / r; };
    return {c_p * k,
            [=](double r, double) {
                return std::array{u(r), 0.0};
            },
            [=](double r, double) {
                const double e = slope(r), h = u(r) / r;
                return std::array{stiff * e + lame * h, lame * (e + h), stiff * h + lame * e, 0.0};
            }};
}

// In a cylinder 1 m wide and 1 m high between rollers: the dilatational mode, the gradient of J0(kr) cos(qz), and the one
// without dilation, the curl of J1(kr) sin(qz); J1(k) = 0.
Mode cylinder_mode(bool dilates) {
    const double k = root(j1, 1.0, 1), q = pi, size = std::hypot(k, q);
    const auto shape = [=](double r, double z) {
        const double across = (dilates ? -k : -q) * j1(k * r) * std::cos(q * z) / size;
        return std::array{across, (dilates ? -q : k) * j0(k * r) * std::sin(q * z) / size};
    };
    const auto stress = [=](double r, double z) {
        const double c = std::cos(q * z) / size, over_r = r > 0.0 ? j1(k * r) / r : 0.5 * k;
        const double er = (dilates ? -k : -q) * (k * j0(k * r) - over_r) * c;
        const double eh = (dilates ? -k : -q) * over_r * c, ez = (dilates ? -q : k) * q * j0(k * r) * c;
        const double gamma = (dilates ? 2.0 * k * q : q * q - k * k) * j1(k * r) * std::sin(q * z) / size;
        const double volumetric = lame * (er + eh + ez);
        return std::array{volumetric + 2 * shear * er, volumetric + 2 * shear * ez,
                          volumetric + 2 * shear * eh, shear * gamma};
    };
    return {(dilates ? c_p : c_s) * size, shape, stress};
}

struct Errors {
    double displacement, velocity, stress;
};

double sum(const std::vector<Mode>& modes, const std::function<double(const Mode&)>& part) {
    double total = 0.0;
    for (const Mode& mode : modes)
        total += speed * part(mode);
    return total;
}

void launch(MovingBody& body, const std::vector<Mode>& modes,
            const std::vector<int>& walls) { // all modes at once
    body.launch(
        [&](double r, double z) {
            return std::array{sum(modes, [&](const Mode& m) { return m.shape(r, z)[0]; }),
                              sum(modes, [&](const Mode& m) { return m.shape(r, z)[1]; })};
        },
        walls);
}

Errors errors(const SmallScene& scene, const std::vector<Mode>& modes, const std::vector<int>& walls) {
    MovingBody body(scene);
    launch(body, modes, walls);
    const double time = 1.125 * 2.0 * pi / modes[0].omega, dt = body.to(time);
    const auto place = [](const PointRecord& r) { return std::pair(r.reference[0], r.reference[1]); };
    const auto exact = [&](const PointRecord& r, int k, auto amplitude) {
        return sum(modes,
                   [&](const Mode& m) { return std::apply(m.shape, place(r))[k] * amplitude(m.omega); });
    };
    return {body.error(
                2, [](auto&, auto, auto& r, int k) { return r.position[k] - r.reference[k]; },
                [&](const PointRecord& r, int k) {
                    return exact(r, k, [&](double omega) { return std::sin(omega * time) / omega; });
                }),
            body.error(
                2, [](auto&, auto, auto& r, int k) { return r.velocity[k]; },
                [&](const PointRecord& r, int k) { // half a step ago
                    return exact(r, k, [&](double omega) { return std::cos(omega * (time - 0.5 * dt)); });
                }),
            body.error(
                4, [](auto& c, auto slot, auto&, int k) { return c.stress[k][slot]; },
                [&](const PointRecord& r, int k) {
                    return sum(modes, [&](const Mode& m) {
                        return std::apply(m.stress, place(r))[k] * std::sin(m.omega * time) / m.omega;
                    });
                })};
}

const std::vector<int> ends{low_y, high_y}, all_sides{low_x, high_x, low_y, high_y};

struct Case {
    const char* name;
    Frame frame;
    Basis basis;
    Symmetry symmetry = Symmetry::axisymmetric;
};

// In theory: displacement of second order, because of the lumped mass and the map M^-1 C; stress of the first with linear
// functions, which jump, of the second with quadratic ones. The points' velocities w = C^-1 M v leave the grid's by a
// share of the cell in the cells at a wall: order 1.5 in L2.
class Vibration : public testing::TestWithParam<Case> {
  protected:
    TestMaterial soil{lame, shear};

    Shape shape(int n) const {
        Shape s;
        s.symmetry = GetParam().symmetry;
        s.frame = GetParam().frame;
        s.basis = GetParam().basis;
        s.lower = {0.5, 0.0};
        s.upper = {1.5, 1.0 / n};
        s.axes = {
            {{n, std::pow(2.0, 1.0 / n)}, {1, 1.0}}}; // the outermost cell twice as wide as the innermost
        s.per_cell = s.symmetry == Symmetry::radial ? 2 : 4;
        return s;
    }
    SmallScene scene(const Shape& s, const std::vector<int>& walls) {
        SmallScene made(s);
        made.add(soil, density);
        made.roll(walls);
        return made;
    }
    void expect_orders(const std::vector<Errors>& e) const {
        for (const Errors& one : e)
            std::printf("%s: displacement %.3e velocity %.3e stress %.3e\n", GetParam().name,
                        one.displacement, one.velocity, one.stress);
        const auto order = [&](double Errors::*field) {
            return std::log2(e[e.size() - 2].*field / e.back().*field);
        };
        const double u = order(&Errors::displacement), v = order(&Errors::velocity),
                     s = order(&Errors::stress);
        std::printf("%s: orders %.2f %.2f %.2f\n", GetParam().name, u, v, s);
        EXPECT_GT(u, 1.9);
        EXPECT_GT(v, 1.4);
        EXPECT_GT(s, GetParam().basis == Basis::linear ? 0.95 : 1.9);
    }
};

TEST_P(Vibration, OfAFreeRingConverges) {
    std::vector<Errors> all;
    for (const int n : {16, 32, 64, 128})
        all.push_back(errors(scene(shape(n), ends), {annulus_mode(0.5, 1.5, false, 1)}, ends));
    expect_orders(all);
}

TEST_P(Vibration, OfARingBetweenWallsConverges) {
    std::vector<Errors> all;
    for (const int n : {16, 32, 64, 128})
        all.push_back(errors(scene(shape(n), all_sides), {annulus_mode(0.5, 1.5, true, 1)}, all_sides));
    expect_orders(all);
}

class VibrationAlongBothAxes : public Vibration {};

TEST_P(VibrationAlongBothAxes, OfACylinderConverges) {
    std::vector<Errors> all;
    for (const int n : {16, 32, 64}) {
        Shape s = shape(n);
        s.lower = {0.0, 0.0};
        s.upper = {1.0, 1.0};
        s.axes = {{{n, 1.0}, {n, 1.0}}};
        all.push_back(errors(scene(s, all_sides), {cylinder_mode(true), cylinder_mode(false)}, all_sides));
    }
    expect_orders(all);
}

// On one grid, against itself with half the step: the central difference in time is of second order.
TEST_P(Vibration, ConvergesInTimeWithSecondOrder) {
    const auto displacements = [&](int steps) {
        const std::vector<Mode> modes{annulus_mode(0.5, 1.5, false, 1)};
        const SmallScene s = scene(shape(16), ends);
        MovingBody body(s);
        launch(body, modes, ends);
        const double dt = 1.125 * 2.0 * pi / modes[0].omega / steps;
        EXPECT_LT(dt, 0.5 * body.solver.allowed_step());
        for (int n = 0; n < steps; ++n)
            body.solver.step(dt);
        std::vector<double> all;
        body.each_point(
            [&](auto&, auto, const PointRecord& r) { all.push_back(r.position[0] - r.reference[0]); });
        return all;
    };
    const auto coarse = displacements(256), middle = displacements(512), fine = displacements(1024);
    double first = 0.0, second = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        first += std::pow(coarse[i] - middle[i], 2);
        second += std::pow(middle[i] - fine[i], 2);
    }
    const double order = 0.5 * std::log2(first / second);
    std::printf("%s: order in time %.2f\n", GetParam().name, order);
    EXPECT_NEAR(order, 2.0, 0.1);
}

const std::vector<Case> axisymmetric{{"LinearTotal", Frame::total, Basis::linear},
                                     {"LinearUpdated", Frame::updated, Basis::linear},
                                     {"QuadraticTotal", Frame::total, Basis::quadratic},
                                     {"QuadraticUpdated", Frame::updated, Basis::quadratic}};
const std::vector<Case> radial{{"LinearRadial", Frame::total, Basis::linear, Symmetry::radial},
                               {"QuadraticRadial", Frame::total, Basis::quadratic, Symmetry::radial}};
const auto name = [](const auto& instance) { return std::string(instance.param.name); };
INSTANTIATE_TEST_SUITE_P(Axisymmetric, Vibration, testing::ValuesIn(axisymmetric), name);
INSTANTIATE_TEST_SUITE_P(Radial, Vibration, testing::ValuesIn(radial), name);
INSTANTIATE_TEST_SUITE_P(Axisymmetric, VibrationAlongBothAxes, testing::ValuesIn(axisymmetric), name);

} // namespace
} // namespace gault::core::test
