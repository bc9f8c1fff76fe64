#include "core/solver/quasi_static.hpp"
#include "small_scene.hpp"

#include <gtest/gtest.h>

#include <random>

namespace gault::core::test {
namespace {

constexpr double lame = 3e6, shear = 2e6, density = 1600.0; // Pa, kg/m^3

struct Use {
    Symmetry symmetry;
    Frame frame;
    Basis basis;
    const char* name;
    VolumetricStrain volumetric_strain = VolumetricStrain::pointwise;
};

Shape shape(const Use& use) {
    Shape s{use.symmetry, use.frame, use.basis, {1.0, 0.0}, {2.0, 1.0}};
    if (use.symmetry == Symmetry::radial) s.axes[1] = {1, 1.0}, s.per_cell = 3;
    return s;
}

class Trial : public testing::TestWithParam<Use> {};
INSTANTIATE_TEST_SUITE_P(
    Everywhere, Trial,
    testing::Values(Use{Symmetry::plane_strain, Frame::total, Basis::quadratic, "PlaneTotal"},
                    Use{Symmetry::plane_strain, Frame::updated, Basis::linear, "PlaneUpdatedLinear"},
                    Use{Symmetry::axisymmetric, Frame::total, Basis::linear, "RingTotalLinear"},
                    Use{Symmetry::axisymmetric, Frame::updated, Basis::quadratic, "RingUpdated"},
                    Use{Symmetry::radial, Frame::total, Basis::quadratic, "RadialTotal"},
                    Use{Symmetry::radial, Frame::updated, Basis::linear, "RadialUpdatedLinear"},
                    Use{Symmetry::plane_strain, Frame::total, Basis::linear, "PlaneTotalCells",
                        VolumetricStrain::cell_mean},
                    Use{Symmetry::axisymmetric, Frame::total, Basis::quadratic, "RingTotalCells",
                        VolumetricStrain::cell_mean},
                    Use{Symmetry::axisymmetric, Frame::updated, Basis::linear, "RingUpdatedCells",
                        VolumetricStrain::cell_mean}),
    [](const auto& instance) { return std::string(instance.param.name); });

// An initial stress that is not isotropic, so that its rotation matters.
void prestress(Body& body) {
    for (Points& points : body.model.points)
        points.each_point([&](std::size_t slot) {
            const double stress[6] = {-9e5, -4e5, -6e5, 2e5, 0.0, 0.0};
            for (int k = 0; k < 6; ++k)
                points.columns().stress[k][slot] = stress[k];
        });
}

VectorField shaken(const NodeLayout& layout, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-size, size);
    VectorField u(layout);
    for (int j = 0; j < layout.ny; ++j)
        for (int i = 0; i < layout.nx; ++i)
            for (int k = 0; k < 2; ++k)
                u.c[k][layout.index(i, j)] = layout.ny == 1 && k == 1 ? 0.0 : any(random);
    return u;
}

TEST_P(Trial, StiffnessIsTheDerivativeOfTheForces) {
    TestMaterial soil(lame, shear);
    SmallScene s{shape(GetParam())};
    s.add(soil, density);
    s.press({0, 3}, 5e5);
    Body body(s.scene);
    prestress(body);
    Boundaries boundaries(s.scene, *body.motion, body.model.behind(s.scene));
    Equilibrium equilibrium(body.model, *body.motion, GetParam().volumetric_strain);
    Stiffness stiffness(body.model.grid), ignored(body.model.grid);
    const NodeLayout& layout = body.layout();
    const VectorField still(layout);
    const auto start = body.motion->save();
    VectorField du = shaken(layout, 0.02, 1);
    const auto forces = [&](const VectorField& u, Stiffness& k) {
        VectorField internal(layout), external(layout);
        EXPECT_TRUE(equilibrium.evaluate(*start, u, {1.0, 1.0}, 1.0, internal, k).found);
        body.motion->attempt(*start, u);
        boundaries.load(*body.motion, 1.0, 1.0, still, external, &k);
        for (int k2 = 0; k2 < 2; ++k2)
            for (std::size_t n = 0; n < internal.c[k2].size(); ++n)
                internal.c[k2][n] += external.c[k2][n];
        return internal;
    };
    forces(du, stiffness);
    const double h = 1e-6;
    for (int j = 0; j < layout.ny; ++j)
        for (int i = 0; i < layout.nx; ++i)
            for (int k = 0; k < (layout.ny == 1 ? 1 : 2); ++k) {
                const std::size_t n = layout.index(i, j);
                VectorField up(du), down(du);
                up.c[k][n] += h;
                down.c[k][n] -= h;
                const VectorField after = forces(up, ignored), before = forces(down, ignored);
                for (int b = 0; b < layout.ny; ++b)
                    for (int a = 0; a < layout.nx; ++a)
                        for (int m = 0; m < 2; ++m) {
                            const std::size_t at = layout.index(a, b);
                            const double slope = (before.c[m][at] - after.c[m][at]) / (2.0 * h);
                            const double found =
                                stiffness.matrix().coeff(stiffness.row(a, b, m), stiffness.row(i, j, k));
                            ASSERT_NEAR(found, slope, 1e-6 * (lame + 2.0 * shear) * 10.0);
                        }
            }
}

void expect_turned_stress(Frame frame, Basis basis) {
    TestMaterial soil(lame, shear);
    SmallScene s{shape({Symmetry::plane_strain, frame, basis, ""})};
    s.add(soil, density);
    Body body(s.scene);
    prestress(body);
    Equilibrium equilibrium(body.model, *body.motion);
    Stiffness stiffness(body.model.grid);
    VectorField internal(body.layout());
    const double c = std::cos(1.3), sine = std::sin(1.3);
    const VectorField du = body.field([&](double x, double y) {
        return std::array<double, 2>{(c - 1.0) * x - sine * y, sine * x + (c - 1.0) * y};
    });
    const auto start = body.motion->save();
    ASSERT_TRUE(equilibrium.evaluate(*start, du, {1.0, 1.0}, 1.0, internal, stiffness).found);
    const Points& points = body.model.points[0];
    points.each_point([&](std::size_t slot) {
        const auto& stress = points.columns().stress;
        ASSERT_NEAR(stress[0][slot], c * c * -9e5 - 2.0 * c * sine * 2e5 + sine * sine * -4e5, 1e-4);
        ASSERT_NEAR(stress[1][slot], sine * sine * -9e5 + 2.0 * c * sine * 2e5 + c * c * -4e5, 1e-4);
        ASSERT_NEAR(stress[2][slot], -6e5, 1e-4);
        ASSERT_NEAR(stress[3][slot], c * sine * (-9e5 + 4e5) + (c * c - sine * sine) * 2e5, 1e-4);
    });
}

TEST(Equilibrium, TurnsTheStressWithABodyThatTurns) {
    expect_turned_stress(Frame::total, Basis::quadratic);
    expect_turned_stress(Frame::updated, Basis::linear);
}

// Stress at the end of a path F(t) = R(turn t) G(t), t from 0 to 1 in equal steps; the axes of G turn as well.
std::array<double, 4> stress_after(double turn, int steps, Basis basis) {
    TestMaterial soil(lame, shear);
    SmallScene s{shape({Symmetry::plane_strain, Frame::total, basis, ""})};
    s.add(soil, density);
    Body body(s.scene);
    prestress(body);
    Equilibrium equilibrium(body.model, *body.motion);
    Stiffness stiffness(body.model.grid);
    VectorField internal(body.layout()), reached(body.layout());
    for (int step = 1; step <= steps; ++step) {
        const double t = static_cast<double>(step) / steps, c = std::cos(turn * t), n = std::sin(turn * t);
        const double g[4] = {1.0 + 0.2 * t, 0.1 * t * t, 0.0, 1.0 - 0.1 * t};
        const VectorField wanted = body.field([&](double x, double y) {
            const double gx = g[0] * x + g[1] * y, gy = g[2] * x + g[3] * y;
            return std::array<double, 2>{c * gx - n * gy - x, n * gx + c * gy - y};
        });
        VectorField du(wanted);
        for (int k = 0; k < 2; ++k)
            for (std::size_t i = 0; i < du.c[k].size(); ++i)
                du.c[k][i] -= reached.c[k][i];
        const auto start = body.motion->save();
        EXPECT_TRUE(equilibrium.evaluate(*start, du, {1.0, 1.0}, 1.0, internal, stiffness).found);
        body.motion->attempt(*start, du);
        body.motion->arrive(du, 1.0);
        reached = wanted;
    }
    std::array<double, 4> stress;
    body.each_point([&](const PointColumns& columns, std::size_t slot, const PointRecord&) {
        for (int k = 0; k < 4; ++k)
            stress[k] = columns.stress[k][slot];
    });
    return stress;
}

// The logarithm of a step's own stretch, after its own rotation: nothing is left of a full turn, however long the steps.
TEST(Equilibrium, ForgetsATurnThatCameWithAStretchExactly) {
    for (const Basis basis : {Basis::linear, Basis::quadratic})
        for (const int steps : {7, 60}) {
            const auto turned = stress_after(2.0 * M_PI, steps, basis),
                       straight = stress_after(0.0, steps, basis);
            for (int k = 0; k < 4; ++k)
                EXPECT_NEAR(turned[k], straight[k], 1e-10 * (lame + 2.0 * shear)) << k;
        }
}

// The step error that is left is that of turning axes, of second order.
TEST(Equilibrium, FollowsTurningAxesToSecondOrder) {
    const auto error = [](int steps) {
        const auto coarse = stress_after(0.0, steps, Basis::linear),
                   exact = stress_after(0.0, 640, Basis::linear);
        double largest = 0.0;
        for (int k = 0; k < 4; ++k)
            largest = std::max(largest, std::abs(coarse[k] - exact[k]));
        return largest;
    };
    const double order = std::log2(error(10) / error(40)) / 2.0;
    EXPECT_GT(order, 1.9);
    EXPECT_LT(order, 2.2);
}

// Of all points, xx yy zz xy, after displacements {f0 x + f1 y, f2 x + f3 y^2} since the beginning, one a step.
std::vector<double> stresses(TestMaterial& soil, const Shape& shape, VolumetricStrain volumetric_strain,
                             const std::vector<std::array<double, 4>>& steps) {
    SmallScene s{shape};
    s.add(soil, density);
    Body body(s.scene);
    Equilibrium equilibrium(body.model, *body.motion, volumetric_strain);
    Stiffness stiffness(body.model.grid);
    VectorField internal(body.layout()), reached(body.layout());
    for (const auto& f : steps) {
        const VectorField wanted = body.field([&](double x, double y) {
            return std::array<double, 2>{f[0] * x + f[1] * y, f[2] * x + f[3] * y * y};
        });
        VectorField du(wanted);
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = 0; n < du.c[k].size(); ++n)
                du.c[k][n] -= reached.c[k][n];
        const auto start = body.motion->save();
        EXPECT_TRUE(equilibrium.evaluate(*start, du, {1.0, 1.0}, 1.0, internal, stiffness).found);
        if (&f == &steps.back()) break;
        body.motion->attempt(*start, du);
        body.motion->arrive(du, 1.0);
        reached = wanted;
    }
    std::vector<double> all;
    body.each_point([&](const PointColumns& columns, std::size_t slot, const PointRecord&) {
        for (int k = 0; k < 4; ++k)
            all.push_back(columns.stress[k][slot]);
    });
    return all;
}

// The volume of a cell is that of its points where they all have the same.
TEST(CellMean, LeavesAHomogeneousDeformationAsItIs) {
    TestMaterial clay(1e3 * shear, shear);
    for (const Frame frame : {Frame::total, Frame::updated})
        for (const Basis basis : {Basis::linear, Basis::quadratic})
            for (const auto& [symmetry, f] :
                 {std::pair(Symmetry::plane_strain, std::array{0.1, 0.05, -0.2, 0.0}),
                  std::pair(Symmetry::axisymmetric, std::array{0.1, 0.0, 0.0, 0.0})}) {
                const Shape block = shape({symmetry, frame, basis, ""});
                const auto own = stresses(clay, block, VolumetricStrain::pointwise, {f});
                const auto mean = stresses(clay, block, VolumetricStrain::cell_mean, {f});
                for (std::size_t i = 0; i < own.size(); ++i)
                    ASSERT_NEAR(mean[i], own[i], 1e-12 * 1e3 * shear);
            }
}

// One point in another place than its neighbours, by one step or by three on another way: the axes stay, so the
// stress must be the same.
TEST(CellMean, DoesNotDependOnTheLengthOfSteps) {
    TestMaterial clay(1e3 * shear, shear);
    const Shape block = shape({Symmetry::axisymmetric, Frame::total, Basis::quadratic, ""});
    const auto one = stresses(clay, block, VolumetricStrain::cell_mean, {{0.1, 0.0, 0.0, 0.1}});
    const auto three = stresses(clay, block, VolumetricStrain::cell_mean,
                                {{0.2, 0.0, 0.0, -0.05}, {0.05, 0.0, 0.0, 0.02}, {0.1, 0.0, 0.0, 0.1}});
    const auto own = stresses(clay, block, VolumetricStrain::pointwise, {{0.1, 0.0, 0.0, 0.1}});
    double change = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_NEAR(three[i], one[i], 1e-12 * 1e3 * shear);
        change = std::max(change, std::abs(one[i] - own[i]));
    }
    EXPECT_GT(change, shear); // volumes of points differ by more than a thousandth
}

// F and the volume ratio are those of the strains that the soil is given.
void expect_gradient_of_the_strain(VolumetricStrain volumetric_strain) {
    TestMaterial fluid(lame, 0.0), soil(lame, 0.0);
    soil.flags = GAULT_FINITE_STRAIN;
    soil.inputs = {"volume_ratio"};
    soil.update = [](gault_points& p, gault_error&) {
        const auto volume = [](const double* const* f, int64_t i) { // nothing shears out of the plane
            return (f[0][i] * f[4][i] - f[1][i] * f[3][i]) * f[8][i];
        };
        for (int64_t i = 0; i < p.count; ++i) {
            p.stress[0][i] = lame * std::log(volume(p.F_new, i));
            p.stress[1][i] = lame * std::log(p.input[0][i]);
            p.stress[2][i] = lame * std::log(volume(p.F_new, i) / volume(p.F_old, i));
            p.stress[3][i] = lame * (p.strain[0][i] + p.strain[1][i] + p.strain[2][i]);
            p.stress[4][i] = p.stress[5][i] = 0.0;
        }
        if (p.modulus) std::fill_n(p.modulus, p.count, 1.0);
        if (p.shear_modulus) std::fill_n(p.shear_modulus, p.count, 1.0);
        return gault_status(GAULT_OK);
    };
    const std::vector<std::array<double, 4>> steps{{0.05, 0.1, -0.05, -0.05}, {0.1, 0.0, 0.1, 0.1}};
    for (const Symmetry symmetry : {Symmetry::plane_strain, Symmetry::axisymmetric}) {
        const Shape block = shape({symmetry, Frame::total, Basis::quadratic, ""});
        const auto found = stresses(soil, block, volumetric_strain, steps);
        const auto expected = stresses(fluid, block, volumetric_strain, steps);
        for (std::size_t i = 0; i < found.size(); i += 4) {
            ASSERT_NEAR(found[i], expected[i], 1e-12 * lame);
            ASSERT_NEAR(found[i + 1], expected[i], 1e-12 * lame);
            ASSERT_NEAR(found[i + 2], found[i + 3], 1e-12 * lame);
        }
    }
}

TEST(Equilibrium, HandsSoilsTheGradientOfTheirStrain) {
    expect_gradient_of_the_strain(VolumetricStrain::pointwise);
    expect_gradient_of_the_strain(VolumetricStrain::cell_mean);
}

// Points gather in the lowest row of cells, which outgrows every batch there was.
TEST(Equilibrium, HasRoomForPointsThatAreLaidOutAnew) {
    TestMaterial soil(lame, shear);
    Shape block = shape({Symmetry::plane_strain, Frame::updated, Basis::quadratic, ""});
    block.axes[1] = {8, 1.0};
    SmallScene s{block};
    s.add(soil, density);
    Body body(s.scene);
    prestress(body);
    Equilibrium before(body.model, *body.motion);
    const int version = body.model.points[0].version();
    body.motion->arrive(body.field([](double, double y) { return std::array{0.0, y * y * y - y}; }), 1.0);
    ASSERT_GT(body.model.points[0].version(), version);
    Equilibrium anew(body.model, *body.motion);
    const VectorField du = shaken(body.layout(), 1e-4, 3);
    const auto start = body.motion->save();
    std::array<VectorField, 2> internal{VectorField(body.layout()), VectorField(body.layout())};
    std::array<Stiffness, 2> stiffness{Stiffness(body.model.grid), Stiffness(body.model.grid)};
    ASSERT_TRUE(before.evaluate(*start, du, {1.0, 1.0}, 1.0, internal[0], stiffness[0]).found);
    ASSERT_TRUE(anew.evaluate(*start, du, {1.0, 1.0}, 1.0, internal[1], stiffness[1]).found);
    EXPECT_EQ(internal[0].c, internal[1].c);
    EXPECT_EQ((stiffness[0].matrix() - stiffness[1].matrix()).norm(), 0.0);
}

// The strain grows by 1e-8 in one component at a time, and F as it does.
TEST(Equilibrium, DifferentiatesWithTheStrainThatItSays) {
    TestMaterial soil(lame, shear);
    soil.flags = GAULT_FINITE_STRAIN;
    std::vector<std::array<double, 8>> seen; // strain, and F xx yy zz xy, of the first point of a batch
    soil.update = [&](gault_points& p, gault_error&) {
        seen.push_back({p.strain[0][0], p.strain[1][0], p.strain[2][0], p.strain[3][0], p.F_new[0][0],
                        p.F_new[4][0], p.F_new[8][0], p.F_new[1][0]});
        return soil.elastic(p);
    };
    SmallScene s{shape({Symmetry::plane_strain, Frame::total, Basis::quadratic, ""})};
    s.add(soil, density);
    Body body(s.scene);
    Equilibrium equilibrium(body.model, *body.motion);
    Stiffness stiffness(body.model.grid);
    VectorField internal(body.layout());
    const auto start = body.motion->save();
    const VectorField du = body.field([](double x, double y) { return std::array{0.1 * x, -0.2 * y}; });
    seen.clear();
    ASSERT_TRUE(equilibrium.evaluate(*start, du, {1.0, 1.0}, 1.0, internal, stiffness).found);
    ASSERT_GE(seen.size(), 5u);
    const double gradient[4] = {1.1, 0.8, 1.0, 0.8}; // what multiplies the shift
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t k = 0; k < 4; ++k) {
            const double shift = k == column ? 1e-8 : 0.0;
            EXPECT_NEAR(seen[column + 1][k] - seen[0][k], shift, 1e-15) << column << k;
            EXPECT_NEAR(seen[column + 1][k + 4] - seen[0][k + 4], shift * gradient[k], 1e-15) << column << k;
        }
}

// A block between rollers whose top goes down by a third.
struct Squeezed {
    TestMaterial soil{lame, shear};
    TestBoundary top;
    SmallScene s;
    std::optional<Model> model;
    std::optional<QuasiStaticSolver> solver;

    explicit Squeezed(Frame frame, double strain_step = 1.0)
        : s(shape({Symmetry::plane_strain, frame, Basis::quadratic, ""})) {
        s.add(soil, density);
        top.constrain = [](gault_nodes& nodes) {
            for (int64_t i = 0; i < nodes.count; ++i) {
                nodes.fixed[1][i] = 1.0;
                nodes.velocity[1][i] = -1.0 / 3.0;
            }
        };
        s.roll({0, 1, 2});
        s.add(top, {3});
        s.scene.solver.strain_step = strain_step;
        s.scene.solver.tolerance = 1e-12;
        model.emplace(build_model(s.scene));
        solver.emplace(s.scene, *model, 1);
    }
    double stress() const { return model->points[0].columns().stress[1][0]; }
};

TEST(QuasiStatic, FindsTheLogarithmicStrainInOneStep) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Squeezed block(frame);
        ASSERT_TRUE(block.solver->step(1.0));
        EXPECT_NEAR(block.stress(), (lame + 2.0 * shear) * std::log(2.0 / 3.0), 1e-2);
        EXPECT_NEAR(block.solver->measure("normal_force", high_y).value(), -block.stress(), 1e-2); // 1 m wide
        EXPECT_LT(block.solver->energies().error(), 1e-12);
    }
}

TEST(QuasiStatic, ShortensStepsToTheStrainThatIsWanted) {
    Squeezed block(Frame::total, 0.01);
    EXPECT_FALSE(block.solver->step(1.0));
    EXPECT_EQ(block.solver->time(), 0.0);
    EXPECT_NEAR(block.solver->allowed_step(), 0.01 / std::log(1.5),
                1e-6); // of the strain that step would have had
    ASSERT_TRUE(block.solver->step(block.solver->allowed_step()));
    EXPECT_NEAR(block.solver->allowed_step(), 0.03, 0.002);
}

TEST(QuasiStatic, TakesAStepBackToTheBit) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        Squeezed block(frame, 0.05);
        while (!block.solver->step(std::min(0.1, block.solver->allowed_step()))) {
        }
        const double stress = block.stress(), time = block.solver->time(),
                     energy = block.solver->energies().internal;
        const double force = block.solver->measure("normal_force", high_y).value();
        ASSERT_TRUE(block.solver->step(block.solver->allowed_step()));
        EXPECT_NE(block.stress(), stress);
        block.solver->undo(0.5);
        EXPECT_EQ(block.stress(), stress);
        EXPECT_EQ(block.solver->time(), time);
        EXPECT_EQ(block.solver->energies().internal, energy);
        EXPECT_EQ(block.solver->measure("normal_force", high_y).value(), force);
    }
}

void expect_quadratic_convergence(double first_lame, VolumetricStrain volumetric_strain) {
    TestMaterial soil(first_lame, shear);
    SmallScene s{shape({Symmetry::axisymmetric, Frame::total, Basis::quadratic, ""})};
    s.add(soil, density);
    s.roll({1, 2});
    s.press({0}, 1.5e6);
    s.scene.solver.strain_step = 1.0;
    s.scene.solver.tolerance = 1e-13;
    s.scene.volumetric_strain = volumetric_strain;
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    ASSERT_TRUE(solver.step(1.0));
    const std::vector<double>& errors = solver.residuals();
    ASSERT_GE(errors.size(), 5u);
    // Above rounding, log(error) doubles.
    int pairs = 0;
    for (std::size_t n = 2; n + 1 < errors.size(); ++n)
        if (errors[n] < 0.03 && errors[n + 1] > 1e-12) {
            EXPECT_GT(std::log(errors[n + 1]) / std::log(errors[n]), 1.8) << n;
            ++pairs;
        }
    EXPECT_GE(pairs, 2);
}

TEST(QuasiStatic, ConvergesQuadratically) {
    expect_quadratic_convergence(lame, VolumetricStrain::pointwise);
    expect_quadratic_convergence(lame, VolumetricStrain::cell_mean);
    expect_quadratic_convergence(100.0 * lame, VolumetricStrain::cell_mean);
}

TEST(QuasiStatic, SaysSoWhenNoEquilibriumExists) {
    TestMaterial soil(lame, shear);
    soil.update = [](gault_points& p, gault_error&) { // carries no stress at all
        for (int64_t i = 0; i < p.count; ++i)
            for (int k = 0; k < 6; ++k)
                p.stress[k][i] = 0.0;
        if (p.modulus) std::fill_n(p.modulus, p.count, 1.0);
        if (p.shear_modulus) std::fill_n(p.shear_modulus, p.count, 1.0);
        return gault_status(GAULT_OK);
    };
    SmallScene s{shape({Symmetry::plane_strain, Frame::total, Basis::linear, ""})};
    s.add(soil, density);
    s.roll({1, 2});
    s.press({0}, 1e3);
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    const auto press_on = [&] {
        for (double dt = 1.0;; dt = solver.allowed_step())
            solver.step(dt);
    };
    EXPECT_THROW(press_on(), RunError);
}

// A soil without a result for a strain of more than `most` in one step; the block is pressed together by 1 %.
double time_reached(double most) {
    TestMaterial soil(lame, shear);
    soil.update = [&](gault_points& p, gault_error& error) {
        for (int64_t i = 0; i < p.count; ++i)
            if (std::abs(p.strain[1][i]) > most) {
                error.point = i;
                std::snprintf(error.text, sizeof error.text, "too far");
                return gault_status(GAULT_FAILED);
            }
        return soil.elastic(p);
    };
    TestBoundary wall;
    wall.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[1][i] = 1.0;
            nodes.velocity[1][i] = nodes.normal[1][i] > 0.0 ? -1.0 : 0.0;
        }
    };
    SmallScene s{shape({Symmetry::plane_strain, Frame::total, Basis::linear, ""})};
    s.add(soil, density);
    s.add(wall, {2, 3});
    Model model = build_model(s.scene);
    QuasiStaticSolver solver(s.scene, model, 1);
    while (solver.time() < 0.01 * (1.0 - 1e-9))
        solver.step(std::min(solver.allowed_step(), 0.01 - solver.time()));
    return solver.time();
}

TEST(QuasiStatic, GoesOnInShorterStepsWhereASoilHasNoResultForATrial) {
    EXPECT_NEAR(time_reached(1e-3), 0.01, 1e-12);
    try {
        time_reached(0.0);
        FAIL();
    } catch (const PointError& error) {
        EXPECT_NE(std::string(error.what()).find("too far"), std::string::npos) << error.what();
        EXPECT_NE(error.call(), nullptr);
    }
}

} // namespace
} // namespace gault::core::test
