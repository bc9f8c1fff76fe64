#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0, pi = std::numbers::pi;

struct Totals {
    double mass = 0.0, volume = 0.0;
    std::array<double, 2> momentum{};
};

Totals totals(Body& body) {
    Totals t;
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
        t.mass += c.mass[slot];
        t.volume += r.volume;
        for (int k = 0; k < 2; ++k)
            t.momentum[k] += c.mass[slot] * c.velocity[k][slot];
    });
    return t;
}

double sum(const Column& c) {
    double total = 0.0;
    for (const double x : c)
        total += x;
    return total;
}

class Moving : public testing::TestWithParam<std::tuple<Symmetry, Basis>> {
  protected:
    TestMaterial soil{lame, shear};
    Shape shape() const {
        Shape form;
        form.frame = Frame::updated;
        std::tie(form.symmetry, form.basis) = GetParam();
        form.axes = {{{8, 1.1}, {6, 1.0}}};
        form.lower = {0.5, 0.0};
        return form;
    }
    bool ring() const { return std::get<0>(GetParam()) == Symmetry::axisymmetric; }
};

// A flow that keeps the walls straight and carries points across cells.
std::array<double, 2> swirl(double x, double y) {
    const double u = (x - 0.5) / 0.5, a = pi * u, b = pi * y;
    return {0.005 * std::sin(a) * std::cos(b), -0.01 * std::cos(a) * std::sin(b)};
}

TEST_P(Moving, PointsThatCrossCellsTakeTheirMassAndMomentumWithThem) {
    SmallScene s(shape());
    s.add(soil, density);
    Body body(s.scene);
    const Totals before = totals(body);
    std::vector<int> cell(body.motion->point_count());
    const auto cells = [&](auto f) {
        for (const Batch& batch : body.model.points[0].layout().batches)
            for (int page = batch.first_page; page < batch.first_page + batch.pages; ++page)
                for (int lane = 0; lane < body.model.points[0].layout().page_live[page]; ++lane) {
                    const uint32_t id =
                        body.model.points[0].identity(static_cast<std::size_t>(page) * page_slots + lane);
                    f(cell[id], batch.cell_row * 8 + body.model.points[0].layout().page_column[page]);
                }
    };
    cells([](int& stored, int now) { stored = now; });
    VectorField velocity(body.layout()), acceleration(velocity), internal(velocity);
    for (int n = 0; n < 40; ++n) {
        acceleration = body.field(swirl);
        for (int k = 0; k < 2; ++k)
            for (double& a : acceleration.c[k])
                a *= n < 20 ? 1.0 : -1.0;
        const Totals old = totals(body);
        body.motion->accelerate(acceleration, 0.2, velocity);
        const Totals now = totals(body);
        for (int k = 0; k < 2; ++k) { // the momentum that the grid gives is the momentum that points get
            double given = 0.0, mapped = 0.0;
            for (std::size_t i = 0; i < body.layout().size; ++i) {
                given += 0.2 * acceleration.c[k][i] * body.motion->mass()[i];
                mapped += velocity.c[k][i] * body.motion->mass()[i];
            }
            ASSERT_NEAR(now.momentum[k] - old.momentum[k], given, 1e-12 * before.mass);
            ASSERT_NEAR(mapped, now.momentum[k], 1e-12 * before.mass);
        }
        for (int side = 0; side < 4; ++side) // straight walls
            for (int k = 0; k < body.model.grid.side_nodes(side); ++k) {
                const auto [i, j] = body.model.grid.side_node(side, k);
                velocity.c[normal_axis(side)][body.layout().index(i, j)] = 0.0;
            }
        body.motion->deform(velocity, {0.2 * (n + 1), 0.2});
        const Totals after = totals(body);
        for (int k = 0; k < 2; ++k)
            ASSERT_NEAR(after.momentum[k], now.momentum[k], 1e-12 * before.mass);
        ASSERT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
        body.motion->forces(internal);
        ASSERT_NEAR(sum(body.motion->mass()), before.mass, 1e-12 * before.mass);
    }
    int crossed = 0;
    cells([&](int stored, int now) { crossed += stored != now; });
    EXPECT_GT(crossed, 50);
    EXPECT_NEAR(totals(body).volume, before.volume, 0.02 * before.volume);
}

TEST_P(Moving, VolumesSumToTheStretchedDomain) {
    SmallScene s(shape());
    s.add(soil, density);
    Body body(s.scene);
    for (int n = 0; n < 20; ++n)
        body.motion->deform(body.field([](double x, double y) {
            return std::array{0.03 * x, -0.02 * y};
        }),
                            {0.2 * (n + 1), 0.2});
    const double x0 = body.model.grid.axis(0).lower(), x1 = body.model.grid.axis(0).upper();
    const double y0 = body.model.grid.axis(1).lower(), y1 = body.model.grid.axis(1).upper();
    EXPECT_NEAR(x1, std::pow(1.006, 20), 1e-13); // the field is that of the moved nodes
    const double domain = (y1 - y0) * (ring() ? pi * (x1 * x1 - x0 * x0) : x1 - x0);
    EXPECT_NEAR(totals(body).volume, domain, 1e-12 * domain);
}

TEST_P(Moving, RefusesToBendAWall) {
    SmallScene s(shape());
    s.add(soil, density);
    Body body(s.scene);
    try {
        for (int n = 0; n < 100; ++n)
            body.motion->deform(body.field([](double x, double y) {
                return std::array{0.05 * std::sin(6 * y) * x, 0.0};
            }),
                                {0.01 * (n + 1), 0.1});
        FAIL();
    } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("use `frame: total`"), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Bodies, Moving,
                         testing::Combine(testing::Values(Symmetry::plane_strain, Symmetry::axisymmetric),
                                          testing::Values(Basis::linear, Basis::quadratic)),
                         [](const auto& instance) {
                             return std::string(std::get<0>(instance.param) == Symmetry::axisymmetric
                                                    ? "Ring"
                                                    : "Block") +
                                    (std::get<1>(instance.param) == Basis::linear ? "Linear" : "Quadratic");
                         });

// Both orders of the stress update are consistent: their answers part by a step's work, of first order.
TEST(StressUpdate, FirstAndLastAgreeToFirstOrderInTheStep) {
    const auto stress = [](StressUpdate order, double dt) {
        TestMaterial soil(lame, shear);
        Shape shape;
        shape.frame = Frame::updated;
        shape.axes = {{{1, 1.0}, {6, 1.0}}};
        SmallScene s(shape);
        s.scene.solver.stress_update = order;
        s.add(soil, density);
        TestBoundary wall;
        wall.constrain = [](gault_nodes& nodes) {
            for (int64_t i = 0; i < nodes.count; ++i) {
                nodes.fixed[1][i] = 1.0;
                nodes.velocity[1][i] = -0.5 * std::pow(std::sin(pi * nodes.time / 8e-3), 2);
            }
        };
        s.add(wall, {3});
        s.roll({0, 1, 2});
        Model model = build_model(s.scene);
        ExplicitSolver solver(s.scene, model, 1);
        EXPECT_GT(solver.allowed_step(), 1e-4);
        for (int n = 0; n < std::lround(6e-3 / dt); ++n)
            solver.step(dt);
        std::vector<double> values(solver.motion().point_count());
        model.points[0].each_point([&](std::size_t slot) {
            values[model.points[0].identity(slot)] = model.points[0].columns().stress[1][slot];
        });
        return values;
    };
    const auto difference = [&](double dt) {
        const auto last = stress(StressUpdate::usl, dt), first = stress(StressUpdate::usf, dt);
        double sum_of_squares = 0.0, size = 0.0;
        for (std::size_t i = 0; i < last.size(); ++i) {
            sum_of_squares += (last[i] - first[i]) * (last[i] - first[i]);
            size += last[i] * last[i];
        }
        return std::sqrt(sum_of_squares / size);
    };
    const double coarse = difference(5e-5), fine = difference(2.5e-5);
    EXPECT_LT(fine, 0.02);
    EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.15);
}

} // namespace
} // namespace gault::core::test
