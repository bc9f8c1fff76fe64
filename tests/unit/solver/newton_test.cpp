// What Newton's method does where a correction or a soil fails.
#include "core/solver/quasi_static.hpp"
#include "small_scene.hpp"

#include <gtest/gtest.h>

namespace gault::core::test {
namespace {

constexpr double lame = 3e6, shear = 2e6, density = 1600.0; // Pa, kg/m^3

Shape linear_block() {
    return {Symmetry::plane_strain, Frame::total, Basis::linear, {1.0, 0.0}, {2.0, 1.0}};
}

std::string message(const std::function<void()>& f) {
    try {
        f();
    } catch (const RunError& error) {
        return error.what();
    }
    return "";
}

struct Loaded { // a block between rollers under a pressure on its left
    SmallScene s;
    std::optional<Model> model;
    std::optional<QuasiStaticSolver> solver;

    Loaded(TestMaterial& soil, double pressure) : s(linear_block()) {
        s.add(soil, density);
        s.roll({1, 2});
        s.press({0}, pressure);
        s.scene.solver.strain_step = 1.0;
        model.emplace(build_model(s.scene));
        solver.emplace(s.scene, *model, 1);
    }
    std::string failure() {
        return message([&] {
            for (double dt = 1.0;; dt = solver->allowed_step())
                if (solver->step(dt)) break;
        });
    }
};

TEST(Newton, NamesThePointWhoseStressIsNotANumber) {
    TestMaterial soil(lame, shear);
    soil.update = [&](gault_points& p, gault_error&) {
        soil.elastic(p);
        if (p.dt > 0.0) p.stress[2][3] = std::nan("");
        return gault_status(GAULT_OK);
    };
    Loaded block(soil, 1e3);
    const std::string where = block.solver->motion().where(0, 3), text = block.failure();
    EXPECT_NE(text.find("(" + where + ": the stress is not finite)"), std::string::npos) << text;
}

TEST(Newton, NamesNoPointWhereTheSoilNamesNone) {
    TestMaterial soil(lame, shear);
    soil.update = [&](gault_points& p, gault_error&) {
        return p.dt == 0.0 ? soil.elastic(p) : gault_status(GAULT_RETRY);
    };
    Loaded block(soil, 1e3);
    const std::string text = block.failure();
    EXPECT_NE(text.find("(material 'soil': the step was too long, and no reason was given)"),
              std::string::npos)
        << text;
}

// The soil becomes stiffer: the first correction goes too far, where the soil has no answer.
TEST(Newton, TakesAPartOfACorrectionThatGoesTooFar) {
    TestMaterial soil(lame, 0.0);
    const double modulus = 1e6, bend = 100.0, farthest = 0.2;
    soil.update = [&](gault_points& p, gault_error&) {
        soil.elastic(p);
        for (int64_t i = 0; i < p.count; ++i)
            for (int k = 0; k < 4; ++k) {
                const double e = p.strain[k][i];
                if (std::abs(e) > farthest) return gault_status(GAULT_RETRY);
                p.stress[k][i] = p.stress_old[k][i] + modulus * (e + bend * e * e * e);
            }
        return gault_status(GAULT_OK);
    };
    Loaded block(soil, 0.3 * modulus);
    ASSERT_TRUE(block.solver->step(1.0));
    EXPECT_EQ(block.solver->allowed_step() > 0.0, true);
    EXPECT_NEAR(block.model->points[0].columns().stress[0][0], -0.3 * modulus, 1e-3 * modulus);
}

// One point of a fluid feels the sum of two free displacements alone.
TEST(Newton, SaysThatTheStiffnessIsSingular) {
    TestMaterial fluid(lame, 0.0);
    TestBoundary top;
    top.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[1][i] = 1.0;
            nodes.velocity[1][i] = -0.01;
        }
    };
    Shape block = linear_block();
    block.axes = {{{1, 1.0}, {1, 1.0}}};
    block.per_cell = 1;
    SmallScene s{block};
    s.add(fluid, density);
    s.roll({1, 2});
    s.add(top, {3});
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    const std::string text = message([&] {
        for (double dt = 1.0; !solver.step(dt); dt = solver.allowed_step()) {
        }
    });
    EXPECT_NE(text.find("(the stiffness matrix is singular)"), std::string::npos) << text;
}

} // namespace
} // namespace gault::core::test
