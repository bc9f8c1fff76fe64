#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0, pi = std::numbers::pi;

std::string message(const std::function<void()>& f) {
    try {
        f();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

struct Simulation { // a scene and its solver
    Model model;
    ExplicitSolver solver;
    explicit Simulation(SmallScene& s, int threads = 1)
        : model(build_model(s.scene)), solver(s.scene, model, threads) {}
    void to(double time) {
        while (solver.time() < time)
            solver.step(std::min(solver.allowed_step(), time - solver.time()));
    }
    template <class F>
    void each_point(F f) { // f(columns, slot, record)
        model.points[0].each_point(
            [&](std::size_t slot) { f(model.points[0].columns(), slot, solver.motion().record(0, slot)); });
    }
};

// frame and order of the stress update
class EverySolver : public testing::TestWithParam<std::tuple<Frame, StressUpdate>> {
  protected:
    TestMaterial soil{lame, shear};
    Shape shape(Symmetry symmetry = Symmetry::plane_strain) const {
        Shape form;
        form.frame = std::get<0>(GetParam());
        form.symmetry = symmetry;
        return form;
    }
    SmallScene scene(const Shape& form) {
        SmallScene made(form);
        made.scene.solver.stress_update = std::get<1>(GetParam());
        made.add(soil, density);
        return made;
    }
};

TEST_P(EverySolver, LetsAFreeBodyFall) {
    SmallScene s = scene(shape());
    s.scene.gravity = {0.0, -9.81};
    Simulation run(s);
    const double dt = run.solver.allowed_step();
    for (int n = 1; n <= 20; ++n)
        run.solver.step(dt);
    run.each_point([&](PointColumns& c, std::size_t slot, const PointRecord& r) {
        ASSERT_NEAR(r.velocity[1], -9.81 * 20 * dt, 1e-12);
        ASSERT_NEAR(r.position[1] - r.reference[1], -9.81 * dt * dt * 20 * 21 / 2, 1e-12); // symplectic Euler
        ASSERT_NEAR(c.stress[1][slot], 0.0, 1e-3);
    });
    EXPECT_LT(run.solver.energies().error(), 1e-12);
    EXPECT_NEAR(run.solver.energies().external, density * 9.81 * 9.81 * dt * dt * 20 * 21 / 2, 1e-9);
}

TEST_P(EverySolver, StaysAtRestInTheStressThatItsWeightAsksFor) {
    for (const Symmetry symmetry : {Symmetry::plane_strain, Symmetry::axisymmetric}) {
        SmallScene s = scene(shape(symmetry));
        s.scene.gravity = {0.0, -9.81};
        s.scene.initial_stress.gravity = true;
        s.scene.initial_stress.k0 = 0.5;
        s.roll(symmetry == Symmetry::axisymmetric ? std::vector{1, 2} : std::vector{0, 1, 2});
        Simulation run(s);
        run.to(0.05);
        EXPECT_GT(run.solver.steps(), 30);
        EXPECT_LT(run.solver.largest_velocity(), 1e-12);
        EXPECT_NEAR(run.solver.measure("normal_force", low_y).value(),
                    density * 9.81 * (symmetry == Symmetry::axisymmetric ? pi : 1.0), 1e-7);
    }
}

// sigma = E(1-nu)/((1+nu)(1-2nu)) strain = (lame + 2 shear) strain: the same in a block and in a cylinder
TEST_P(EverySolver, CompressesUniaxiallyByTheConstrainedModulus) {
    constexpr double pressure = 1e3;
    for (const Symmetry symmetry : {Symmetry::plane_strain, Symmetry::axisymmetric}) {
        SmallScene s = scene(shape(symmetry));
        s.scene.solver.damping = 0.7;
        s.roll(symmetry == Symmetry::axisymmetric ? std::vector{1, 2} : std::vector{0, 1, 2});
        s.press({3}, pressure);
        Simulation run(s);
        run.to(0.3);
        const double strain = pressure / (lame + 2 * shear);
        EXPECT_NEAR(run.solver.measure("displacement", high_y).value(), strain,
                    1e-3 * strain); // finite strain: strain / 2
        run.each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
            ASSERT_NEAR(c.stress[1][slot], -pressure, 1e-3 * pressure);
            ASSERT_NEAR(c.stress[0][slot], -pressure * lame / (lame + 2 * shear), 1e-3 * pressure);
            ASSERT_NEAR(c.stress[2][slot], c.stress[0][slot], 1e-3 * pressure);
        });
    }
}

TEST_P(EverySolver, MovesAWallAsItIsTold) {
    SmallScene s = scene(shape(Symmetry::axisymmetric));
    s.scene.geometry.lower = {0.3, 0.0};
    TestBoundary wall;
    wall.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[0][i] = 1.0;
            nodes.velocity[0][i] = -0.5 * std::sin(40.0 * nodes.time) * nodes.normal[0][i];
        }
    };
    s.add(wall, {0});
    s.roll({2, 3});
    Simulation run(s);
    double travel = 0.0;
    for (int n = 0; n < 40; ++n) {
        const double dt = run.solver.allowed_step();
        travel += dt * 0.5 * std::sin(40.0 * (run.solver.time() + dt)); // what acts at the end of the step
        run.solver.step(dt);
    }
    EXPECT_NEAR(run.solver.measure("radius", low_x).value(), 0.3 + travel, 1e-14);
    EXPECT_NEAR(run.solver.measure("displacement", low_x).value(), travel, 1e-14);
    EXPECT_DOUBLE_EQ(run.solver.measure("initial_radius", low_x).value(), 0.3);
    EXPECT_DOUBLE_EQ(run.solver.measure("initial_area", low_x).value(), 2 * pi * 0.3);
}

// Velocities lag the positions by half a step: the sum of kinetic and internal energy swings, but does not
// drift.
TEST_P(EverySolver, KeepsTheEnergyOfAnElasticBodyThatRings) {
    SmallScene s = scene(shape());
    s.scene.initial_stress.vertical = 10e3; // released at once
    s.scene.solver.time_step_factor = 0.3;
    Simulation run(s);
    const auto mean = [&](double& largest) { // over 500 steps, some 40 periods of the slowest mode
        double sum = 0.0;
        for (int n = 0; n < 500; ++n) {
            run.solver.step(run.solver.allowed_step());
            const Energies e = run.solver.energies();
            EXPECT_EQ(e.external, 0.0);
            largest = std::max(largest, e.kinetic);
            sum += e.kinetic + e.internal;
        }
        return sum / 500;
    };
    double largest = 0.0;
    const double first = mean(largest), second = mean(largest), third = mean(largest);
    EXPECT_GT(largest, 0.0);
    const double swing = 0.08 * largest; // its mean over 40 periods is no better than a 40th
    EXPECT_LT(std::abs(second - first), swing / 40);
    EXPECT_LT(std::abs(third - first), swing / 40);
}

TEST_P(EverySolver, ComesToRestWithLocalDamping) {
    SmallScene s = scene(shape());
    s.scene.solver.damping = 0.8;
    s.press({0, 1, 2, 3}, 5e3);
    s.scene.solver.time_step_factor = 0.3; // the work of forces that jump is accounted for to first order
    Simulation run(s);
    run.to(0.02);
    const double early = run.solver.energies().kinetic;
    run.to(0.3);
    EXPECT_LT(run.solver.energies().kinetic, 1e-4 * early);
    EXPECT_LT(run.solver.energies().damping, 0.0) << "damping takes energy";
    EXPECT_LT(run.solver.energies().error(), 0.02);
    EXPECT_LT(run.solver.measure("kinetic_ratio", 0).value(), 1e-6);
}

TEST_P(EverySolver, IsAsHeavyAsItsMassScalingSays) {
    SmallScene light = scene(shape()), heavy = scene(shape());
    heavy.scene.solver.mass_scaling = 100.0;
    for (SmallScene* s : {&light, &heavy})
        s->press({1}, 5e3);
    Simulation a(light), b(heavy);
    const double dt = a.solver.allowed_step();
    EXPECT_NEAR(b.solver.allowed_step(), 10.0 * dt, 0.01 * dt);
    a.solver.step(dt);
    b.solver.step(dt);
    EXPECT_NEAR(a.solver.largest_velocity(), 100.0 * b.solver.largest_velocity(), 1e-12);
}

TEST_P(EverySolver, ScalesInertiaAndNotWeight) {
    SmallScene s = scene(shape());
    s.scene.solver.mass_scaling = 4.0;
    s.scene.gravity = {0.0, -8.0};
    Simulation run(s);
    run.solver.step(1e-4);
    EXPECT_NEAR(run.solver.largest_velocity(), 2.0 * 1e-4, 1e-15);
}

TEST_P(EverySolver, CountsUpdatesOfPointsAndNotOfEmptySlots) {
    for (const int per_cell : {1, 4, 16}) {
        Shape form = shape();
        form.per_cell = per_cell;
        SmallScene s = scene(form);
        Simulation run(s);
        for (int n = 0; n < 3; ++n)
            run.solver.step(run.solver.allowed_step());
        EXPECT_EQ(run.solver.updates(), 3 * 4 * 3 * per_cell);
    }
}

INSTANTIATE_TEST_SUITE_P(Frames, EverySolver,
                         testing::Values(std::tuple(Frame::total, StressUpdate::usl),
                                         std::tuple(Frame::updated, StressUpdate::usl),
                                         std::tuple(Frame::updated, StressUpdate::usf)),
                         [](const auto& instance) {
                             return std::string(std::get<0>(instance.param) == Frame::total ? "Total"
                                                                                            : "Updated") +
                                    (std::get<1>(instance.param) == StressUpdate::usl ? "Usl" : "Usf");
                         });

TEST(ExplicitSolver, OffersTheMeasuresOfTheContractAndNoOther) {
    TestMaterial soil(lame, shear);
    SmallScene s{Shape{}};
    s.add(soil, density);
    Simulation run(s);
    run.solver.step(run.solver.allowed_step());
    for (const std::string& name : ExplicitSolver::measure_names())
        EXPECT_TRUE(std::isfinite(run.solver.measure(name, high_x).value())) << name;
    EXPECT_FALSE(run.solver.measure("temperature", 0));
    EXPECT_TRUE(ExplicitSolver::measures_surface("normal_force"));
    EXPECT_TRUE(ExplicitSolver::measures_surface("enclosed_volume"));
    EXPECT_FALSE(ExplicitSolver::measures_surface("kinetic_energy"));
    EXPECT_FALSE(ExplicitSolver::measures_surface("temperature"));
}

TEST(ExplicitSolver, FindsTheLimitAnewWhenTheSoilIsStifferOrHasStrained) {
    TestMaterial soil(lame, shear);
    double stiffer = 1.0;
    soil.update = [&](gault_points& p, gault_error&) {
        soil.elastic(p);
        for (int64_t i = 0; p.modulus && i < p.count; ++i) {
            p.modulus[i] *= stiffer;
            p.shear_modulus[i] *= stiffer;
        }
        return gault_status(GAULT_OK);
    };
    SmallScene s{Shape{}};
    s.add(soil, density);
    TestBoundary wall;
    wall.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[1][i] = 1.0;
            nodes.velocity[1][i] = nodes.normal[1][i] > 0.0 ? -1.0 : 0.0;
        }
    };
    s.add(wall, {2, 3});
    Simulation run(s);
    const double first = run.solver.allowed_step();
    stiffer = 4.0;
    run.solver.step(0.1 * first);
    EXPECT_NEAR(run.solver.allowed_step(), 0.5 * first, 0.05 * first) << "at once";
    const double second = run.solver.allowed_step();
    stiffer = 1.0;
    run.solver.step(0.1 * first);
    EXPECT_EQ(run.solver.allowed_step(), second) << "little strain so far";
    for (int n = 0; n < 60 && run.solver.allowed_step() == second; ++n)
        run.solver.step(0.25 * first);
    EXPECT_NEAR(run.solver.allowed_step(), first, 0.1 * first);
}

TEST(ExplicitSolver, TellsWhereAnUnstableRunWasLost) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Shape shape;
        shape.frame = frame;
        shape.axes = {{{4, 1.0}, {4, 1.0}}};
        TestMaterial soil(lame, shear);
        SmallScene s(shape);
        s.add(soil, density, "soil");
        s.scene.initial_stress.vertical = 10e3;
        s.roll({0, 1, 2, 3}); // straight walls
        s.scene.gravity = {0.0, -10.0};
        s.scene.solver.time_step_factor = 1.1;
        Simulation run(s);
        const std::string text = message([&] {
            for (int n = 0; n < 3000; ++n)
                run.solver.step(run.solver.allowed_step());
        });
        EXPECT_NE(text.find("the run became unstable: point "), std::string::npos) << text;
        EXPECT_NE(text.find("of 'soil' at ("), std::string::npos) << text;
    }
}

// ---- boundaries ---------------------------------------------------------------------------------------

class Bounded : public testing::Test {
  protected:
    TestMaterial soil{lame, shear};
    SmallScene s{Shape{}};
    TestBoundary one, two;
    Bounded() { s.add(soil, density); }
    static auto moving(double velocity) {
        return [velocity](gault_nodes& nodes) {
            for (int64_t i = 0; i < nodes.count; ++i) {
                nodes.fixed[0][i] = 1.0;
                nodes.velocity[0][i] = velocity;
            }
        };
    }
};

TEST_F(Bounded, TwoConditionsMayAgree) {
    one.constrain = two.constrain = moving(0.25);
    s.add(one, {0});
    s.add(two, {2});
    EXPECT_NO_THROW(Simulation(s).solver.step(1e-6));
}

TEST_F(Bounded, TwoConditionsThatContradictAreAnErrorBeforeTheFirstStep) {
    one.constrain = moving(0.25);
    two.constrain = moving(0.0);
    s.add(one, {0});
    s.add(two, {2});
    EXPECT_EQ(message([&] { Simulation run(s); }), "scene.yaml:7:3: boundary 'test_boundary' on bottom "
                                                   "prescribes v_x = 0 m/s at a node where another boundary "
                                                   "prescribes 0.25 m/s");
}

// Before the first step dt is 0, and so is the way left.
TEST_F(Bounded, AWallMayBeDrivenToADisplacement) {
    const auto wanted = [](double time) { return 0.1 * time; };
    one.constrain = [&](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[1][i] = 1.0;
            nodes.velocity[1][i] = (wanted(nodes.time) - nodes.displacement[1][i]) / nodes.dt;
        }
    };
    s.add(one, {3});
    Simulation run(s);
    run.to(1e-3);
    EXPECT_NEAR(run.solver.measure("displacement", high_y).value(), -wanted(1e-3), 1e-15);
}

TEST_F(Bounded, AVelocityThatIsNotANumberEndsTheRun) {
    one.constrain = [](gault_nodes& nodes) { moving(nodes.time > 0.0 ? std::nan("") : 0.0)(nodes); };
    s.add(one, {0});
    Simulation run(s);
    EXPECT_THROW(run.solver.step(1e-6), RunError);
}

TEST_F(Bounded, AWallThatIsReleasedIsLoadedFromItsFirstStepOn) {
    s.scene.initial_stress.vertical = 10e3;
    s.roll({0, 1, 2});
    one.controls = {{"drive", "1", "", 0.0}};
    one.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i)
            nodes.fixed[1][i] = nodes.control[0] == 0.0 ? 1.0 : 0.0;
    };
    one.load = [](gault_facets& f) {
        for (int64_t i = 0; i < f.count; ++i)
            f.pressure[i] = f.control[0] == 1.0 ? 10e3 : 0.0;
    };
    s.add(one, {3});
    Simulation run(s);
    std::string unit;
    for (const double drive : {0.0, 1.0, 0.0, 1.0}) {
        for (double* control : run.solver.boundaries().listeners("drive", high_y, unit))
            *control = drive;
        for (int n = 0; n < 3; ++n)
            run.solver.step(run.solver.allowed_step());
        EXPECT_LT(run.solver.largest_velocity(), 1e-12) << drive;
        EXPECT_NEAR(run.solver.measure("normal_force", high_y).value(), 10e3, 1e-6) << drive;
    }
}

TEST_F(Bounded, ARefusalNamesTheBoundaryAndItsSurfaces) {
    one.load = [](gault_facets&) {};
    one.answer = GAULT_FAILED;
    s.add(one, {0, 3});
    Simulation run(s);
    EXPECT_EQ(message([&] { run.solver.step(1e-6); }),
              "boundary 'test_boundary' on left, top: no result and no reason");
    one.answer = GAULT_RETRY;
    EXPECT_EQ(message([&] { run.solver.step(1e-6); }),
              "boundary 'test_boundary' on left, top: no result and no reason (a boundary cannot ask for a "
              "shorter step)");
}

TEST_F(Bounded, ConditionsSeePositionsNormalsTimesAndControls) {
    std::array<double, 6> seen{};
    one.controls = {{"speed", "m/s", "", 0.75}};
    one.constrain = [&](gault_nodes& n) {
        seen = {n.time, n.dt, n.position[1][0], n.normal[1][0], n.displacement[1][0], n.control[0]};
        for (int64_t i = 0; i < n.count; ++i) {
            n.fixed[1][i] = 1.0;
            n.velocity[1][i] = 0.5;
        }
    };
    s.add(one, {3});
    Simulation run(s);
    run.solver.allowed_step();
    run.solver.step(1e-5);
    EXPECT_EQ(seen, (std::array{1e-5, 1e-5, 1.0, 1.0, 0.0, 0.75}));
    std::string unit;
    for (double* control : run.solver.boundaries().listeners("speed", high_y, unit))
        *control = 2.0;
    EXPECT_EQ(unit, "m/s");
    run.solver.step(1e-5);
    EXPECT_DOUBLE_EQ(seen[0], 2e-5);
    EXPECT_NEAR(seen[4], 0.5e-5, 1e-15);
    EXPECT_EQ(seen[5], 2.0);
    EXPECT_TRUE(run.solver.boundaries().listeners("speed", low_x, unit).empty());
    EXPECT_EQ(run.solver.boundaries().control_names(std::nullopt), std::vector<std::string>{"speed"});
}

TEST_F(Bounded, LoadsSeeTheSoilBehindThemAndTheVelocity) {
    std::array<double, 6> seen{};
    one.load = [&](gault_facets& f) {
        seen = {f.impedance[0][0],        f.impedance[1][0], f.shear_modulus[0],
                f.initial_traction[0][0], f.velocity[0][0],  f.normal[0][0]};
        for (int64_t i = 0; i < f.count; ++i)
            f.traction[0][i] = -100.0; // dead load
    };
    s.add(one, {0});
    s.scene.initial_stress.vertical = 10e3;
    s.scene.initial_stress.k0 = 0.5;
    Simulation run(s);
    run.solver.step(1e-6);
    EXPECT_NEAR(seen[0], std::sqrt(density * (lame + 2 * shear)), 1e-6);
    EXPECT_NEAR(seen[1], std::sqrt(density * shear), 1e-6);
    EXPECT_EQ(seen[2], shear);
    EXPECT_EQ(seen[3], 5e3); // -x normal, compression
    EXPECT_EQ(seen[5], -1.0);
    EXPECT_NEAR(run.solver.measure("normal_force", low_x).value(), -100.0,
                1e-7); // the surface has moved a little
    run.solver.step(1e-6);
    EXPECT_LT(seen[4], 0.0) << "the soil moves out";
}

TEST_F(Bounded, DescriptionsSayWhatWasTakenHoldOf) {
    one.constrain = moving(0.0);
    two.load = [](gault_facets&) {};
    s.add(one, {0, 1});
    s.add(two, {3});
    Simulation run(s); // 4 x 3 cells, quadratic: 5 nodes on a side, 3 quadrature points a cell
    EXPECT_EQ(run.solver.boundaries().description(),
              (std::vector<std::string>{"test_boundary on left, right: 10 nodes",
                                        "test_boundary on top: 12 quadrature points"}));
}

} // namespace
} // namespace gault::core::test
