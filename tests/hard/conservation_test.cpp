// What nothing acts on keeps: mass to the bit, linear momentum to rounding, and an elastic body its energy, with a swing
// of the second order in the step and no drift.
#include "tests/hard/moving_body.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <map>
#include <numbers>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0, pi = std::numbers::pi;

struct Case {
    const char* name;
    Frame frame;
    Basis basis;
    Symmetry symmetry;
};

class Conserved : public testing::TestWithParam<Case> {
  protected:
    TestMaterial soil{lame, shear};
    SmallScene scene(int columns, int rows) {
        Shape shape;
        shape.symmetry = GetParam().symmetry;
        shape.frame = GetParam().frame;
        shape.basis = GetParam().basis;
        shape.lower = {0.5, 0.0};
        shape.upper = {1.5, 1.0};
        shape.axes = {{{columns, std::pow(2.0, 1.0 / columns)}, {rows, 1.0}}};
        shape.per_cell = 4;
        SmallScene s(shape);
        s.add(soil, density);
        return s;
    }
    bool axisymmetric() const { return GetParam().symmetry == Symmetry::axisymmetric; }
};

const auto name = [](const auto& instance) { return std::string(instance.param.name); };
const std::vector<Case> plane{{"TotalLinear", Frame::total, Basis::linear, Symmetry::plane_strain},
                              {"TotalQuadratic", Frame::total, Basis::quadratic, Symmetry::plane_strain},
                              {"UpdatedLinear", Frame::updated, Basis::linear, Symmetry::plane_strain},
                              {"UpdatedQuadratic", Frame::updated, Basis::quadratic, Symmetry::plane_strain}};
const std::vector<Case> rings{{"TotalQuadratic", Frame::total, Basis::quadratic, Symmetry::axisymmetric},
                              {"UpdatedQuadratic", Frame::updated, Basis::quadratic, Symmetry::axisymmetric}};

INSTANTIATE_TEST_SUITE_P(Plane, Conserved, testing::ValuesIn(plane), name);
INSTANTIATE_TEST_SUITE_P(Rings, Conserved, testing::ValuesIn(rings), name);

// Of all points, and whether each is there once.
struct Sums {
    double mass = 0.0, momentum[2] = {0.0, 0.0},
           size = 0.0; // of the nodes; of the points, and of its magnitudes
    std::map<uint32_t, double> point_mass;
    std::map<uint32_t, int> column; // of cells
};

Sums sums_of(MovingBody& body) {
    Sums all;
    for (const double m : body.solver.motion().mass())
        all.mass += m;
    const Points& points = body.model.points[0];
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
        const double radius = body.model.grid.axisymmetric() ? r.reference[0] : 1.0;
        const double mass = c.mass.empty() ? density * c.measure[slot] * radius : c.mass[slot];
        EXPECT_TRUE(all.point_mass.emplace(points.identity(slot), mass).second) << "a point twice";
        all.column[points.identity(slot)] = points.layout().page_column[slot / page_slots];
        for (int k = 0; k < 2; ++k) {
            all.momentum[k] += mass * r.velocity[k];
            all.size += mass * std::abs(r.velocity[k]);
        }
    });
    return all;
}

struct Kept {
    double mass = 0.0, momentum[2] = {0.0, 0.0}; // largest relative changes
    int crossed = 0;                             // most points at a time in another column of cells
};

Kept follow(MovingBody& body, int steps) {
    const Sums start = sums_of(body);
    Kept kept;
    for (int n = 0; n < steps; ++n) {
        body.solver.step(0.5 * body.solver.allowed_step());
        const Sums now = sums_of(body);
        EXPECT_EQ(now.point_mass, start.point_mass);
        kept.mass = std::max(kept.mass, std::abs(now.mass / start.mass - 1.0));
        for (int k = 0; k < 2; ++k)
            kept.momentum[k] =
                std::max(kept.momentum[k], std::abs(now.momentum[k] - start.momentum[k]) / start.size);
        int away = 0;
        for (const auto& [point, column] : now.column)
            away += column != start.column.at(point);
        kept.crossed = std::max(kept.crossed, away);
    }
    return kept;
}

// Of a sum over 256 points and 300 steps, should every rounding be off the same way: 256 x 1e-16 a sum.
constexpr double rounding = 3e-14;

// So little motion that walls stay straight, as the updated frame wants them.
TEST_P(Conserved, MassAndMomentumOfAFreeBody) {
    SmallScene s = scene(8, 8);
    MovingBody body(s);
    body.launch(
        [](double x, double y) {
            return std::array{0.03 + 0.1 * std::cos(pi * x) * y, 0.1 * std::sin(2.0 * x + y) - 0.01};
        },
        {});
    const double exact = density * (axisymmetric() ? 2.0 * pi : 1.0);
    EXPECT_NEAR(sums_of(body).mass, exact, rounding * exact);
    const Kept kept = follow(body, 300);
    std::printf("%s, free: mass %.1e, momentum %.1e %.1e\n", GetParam().name, kept.mass, kept.momentum[0],
                kept.momentum[1]);
    EXPECT_LT(kept.mass, rounding);
    EXPECT_LT(kept.momentum[1], rounding);
    if (!axisymmetric()) { // along the radius a ring pulls itself back
        EXPECT_LT(kept.momentum[0], rounding);
    }
}

// A bar between rollers that moves along itself, so much that points change their cells in the updated frame.
class Bar : public Conserved {
  protected:
    static constexpr double modulus = lame + 2.0 * shear;
    SmallScene bar() {
        SmallScene s = scene(48, 1);
        s.roll({low_y, high_y});
        return s;
    }
    static void launch(MovingBody& body) {
        body.launch(
            [](double x, double) {
                return std::array{10.0 + 20.0 * std::cos(pi * (x - 0.5)), 0.0};
            },
            {low_y, high_y});
    }
};

INSTANTIATE_TEST_SUITE_P(Plane, Bar, testing::ValuesIn(plane), name);

TEST_P(Bar, KeepsMassAndMomentumWhilePointsCrossCells) {
    SmallScene s = bar();
    MovingBody body(s);
    launch(body);
    const Kept kept = follow(body, 300);
    std::printf("%s, crossing: mass %.1e, momentum %.1e; %d points in another cell\n", GetParam().name,
                kept.mass, kept.momentum[0], kept.crossed);
    EXPECT_EQ(kept.crossed > 0, GetParam().frame == Frame::updated);
    EXPECT_LT(kept.mass, rounding);
    EXPECT_LT(kept.momentum[0], rounding);
}

struct Balance {
    double swing, drift, books; // of the energy, over that at the start
};

// `stored` is the energy of the points' stresses, at the time of the kinetic energy.
Balance balance_of(MovingBody& body, double share, double end, const std::function<double()>& stored) {
    const double start = body.solver.motion().kinetic_energy(), dt = share * body.solver.allowed_step();
    const int steps = static_cast<int>(end / dt), tenth = steps / 10;
    double low = HUGE_VAL, high = 0.0, first = 0.0, last = 0.0, books = 0.0;
    for (int n = 0; n < steps; ++n) {
        body.solver.step(dt);
        const Energies e = body.solver.energies();
        const double total = e.kinetic + stored();
        low = std::min(low, total);
        high = std::max(high, total);
        first += n < tenth ? total / tenth : 0.0;
        last += n >= steps - tenth ? total / tenth : 0.0;
        books = std::max(books, std::abs(e.kinetic + e.internal - e.external - start) / start);
    }
    return {(high - low) / start, (last - first) / start, books};
}

void print(const char* body, double share, const Balance& b) {
    std::printf("%s, step %.3f of the limit: swing %.2e, drift %.1e, books %.1e\n", body, share, b.swing,
                b.drift, b.books);
}

// Some 25 times the time that a wave takes across and back. Where stress is linear in the displacement, central
// differences keep v(t - dt/2) m v(t + dt/2) / 2 + u k u / 2 whatever the step; strains of 4e-9 leave as much to the rest.
TEST_P(Conserved, EnergyOfASmallMotion) {
    for (const double share : {1.0, 0.25}) {
        SmallScene s = scene(8, 8);
        MovingBody body(s);
        body.launch(
            [](double x, double y) {
                return std::array{1e-6 * std::cos(pi * x) * y, 1e-6 * std::sin(2.0 * x + y)};
            },
            {});
        const Balance b = balance_of(body, share, 0.2, [&] {
            double energy = 0.0;
            body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
                const double trace = c.stress[0][slot] + c.stress[1][slot] + c.stress[2][slot];
                double square = 2.0 * c.stress[3][slot] * c.stress[3][slot];
                for (int k = 0; k < 3; ++k)
                    square += c.stress[k][slot] * c.stress[k][slot];
                energy += r.volume * (square - lame / (3 * lame + 2 * shear) * trace * trace) / (4 * shear);
            });
            return energy;
        });
        print(GetParam().name, share, b);
        EXPECT_LT(b.swing, 10 * 4e-9);
        EXPECT_LT(b.books, 10 * 4e-9);
    }
}

// A bar whose stress is M ln f, f its stretch, stores M (f ln f - f + 1) of its initial volume. The two energies are known
// at the same time: their sum swings with the square of the step and does not drift. Points that move through the grid
// change its mass and weights from step to step, which costs an order; with linear functions, stability.
class StretchedBar : public Bar {};
INSTANTIATE_TEST_SUITE_P(Plane, StretchedBar, testing::Values(plane[0], plane[1], plane[3]), name);

TEST_P(StretchedBar, KeepsItsEnergy) {
    std::vector<double> swings, books;
    const bool total = GetParam().frame == Frame::total;
    for (const double share : {1.0, 0.5, 0.25, 0.125}) {
        SmallScene s = bar();
        MovingBody body(s);
        launch(body);
        const Balance b = balance_of(body, share, 0.02, [&] {
            double energy = 0.0;
            body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
                const double f = std::exp(c.stress[0][slot] / modulus);
                energy += r.volume / f * modulus * (f * std::log(f) - f + 1.0);
            });
            return energy;
        });
        print(GetParam().name, share, b);
        swings.push_back(b.swing);
        books.push_back(b.books);
        EXPECT_LT(std::abs(b.drift), total ? 0.1 * b.swing : b.swing);
        if (total) { // v after the step, times the change of momentum, is the work of the same forces
            EXPECT_LT(b.books, rounding);
        }
    }
    std::printf("%s: orders of the swing %.2f, of the books %.2f\n", GetParam().name, last_order(swings),
                last_order(books));
    EXPECT_GT(last_order(swings), total ? 1.9 : 0.9);
    if (!total) {
        EXPECT_GT(last_order(books), 0.9);
    }
}

} // namespace
} // namespace gault::core::test
