#include "laboratory.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cfloat>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

namespace {
using namespace plugin_test;

const std::string umats = GAULT_BINARY_DIR "/lib/gault/umat/test/";
constexpr double lame = 40e6, shear = 20e6; // Pa, of the UMATs that are isotropic

Settings settings(const std::string& library, const std::string& symbol = "", Settings more = {}) {
    more["library"] = umats + library + ".so";
    if (!symbol.empty()) more["symbol"] = symbol;
    return more;
}
Points list(const std::vector<double>& numbers) { // as the fixture writes a list
    Points points;
    for (double x : numbers)
        points.push_back({0.0, x});
    return points;
}
const Points isotropic = list({lame, shear});

Component create(const Settings& with, const std::string& variant = "") {
    return {"umat", GAULT_MATERIAL, "umat", with, variant};
}

// The fixture lays out the states that a component declares. Those of a UMAT follow from its parameters, so
// this is a copy of the component that declares those of one instance.
struct Umat {
    Component instance;
    gault_material_api api = instance.api<gault_material_api>();
    gault_component declaration = instance.declaration();
    const gault_component* list[2] = {&declaration, nullptr};
    gault_module module{};
    std::unique_ptr<Component> component;

    explicit Umat(const Settings& with, const std::string& variant = "") : instance(create(with, variant)) {
        api.states = api.instance_states(instance.self(), &api.state_count);
        declaration.api = &api;
        module.components = list;
        component = std::make_unique<Component>(module, GAULT_MATERIAL, "umat", with);
    }
    Umat(const Umat&) = delete;
    operator const Component&() const { return *component; }
};

struct Random {
    std::mt19937_64 engine{5};
    double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine); }
    Tensor tensor(double size) {
        Tensor t;
        for (double& c : t)
            c = size * uniform();
        return t;
    }
};

std::string failure(const Settings& with, double strain, double stress = 0.0, bool tangent = false) {
    const Umat soil(with);
    Batch b(soil, 5, tangent);
    for (int64_t i = 0; i < b.count(); ++i)
        b.set_stress_old(i, {stress, stress, stress, 0.0, 0.0, 0.0});
    b.strain[0][3] = strain;
    return b.update() == GAULT_FAILED && b.error.point == 3 ? b.error.text : "no failure of point 3";
}
std::string refused_start(const Settings& with, double stress) {
    const Umat soil(with);
    Batch b(soil, 1);
    b.set_stress_old(0, {stress, stress, stress, 0.0, 0.0, 0.0});
    return b.start() == GAULT_FAILED && b.error.point == 0 ? b.error.text : "accepted";
}
bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// ---- elasticity of any symmetry: every component in its place -------------------------------------------

using Direction = std::array<double, 3>;
double length(const Direction& v) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

struct Elasticity { // c[i][j][k][l] from the lower triangle in the order of Abaqus, as a textbook says
    double c[3][3][3][3];

    explicit Elasticity(const std::vector<double>& triangle) {
        constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}; // 11 22 33 12 13 23
        std::size_t n = 0;
        for (const auto& a : pair)
            for (const auto& b : pair) {
                set(a, b, triangle[n]), set(b, a, triangle[n]), ++n;
                if (&a - pair == &b - pair) break;
            }
    }
    Tensor stress(const Tensor& e) const {
        constexpr int of[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; // xx yy zz xy yz zx
        Tensor s{};
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j)
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l < 3; ++l)
                        s[of[i][j]] += c[i][j][k][l] * e[of[k][l]];
        return s;
    }
    double fastest_wave_modulus(const Direction& n) const { // by power iteration on the acoustic tensor
        Direction m{0.6, 0.64, 0.48};
        double modulus = 0.0;
        for (int iteration = 0; iteration < 60; ++iteration) {
            Direction moved{};
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    for (int k = 0; k < 3; ++k)
                        for (int l = 0; l < 3; ++l)
                            moved[i] += c[i][j][k][l] * n[j] * n[l] * m[k];
            modulus = length(moved);
            m = {moved[0] / modulus, moved[1] / modulus, moved[2] / modulus};
        }
        return modulus;
    }

  private:
    void set(const int (&a)[2], const int (&b)[2], double value) {
        c[a[0]][a[1]][b[0]][b[1]] = c[a[1]][a[0]][b[0]][b[1]] = value;
        c[a[0]][a[1]][b[1]][b[0]] = c[a[1]][a[0]][b[1]][b[0]] = value;
    }
};

// 21 constants, all different, of a stiffness that is positive definite: the diagonal outweighs each row.
std::vector<double> triclinic(Random& random) {
    std::vector<double> triangle;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j)
            triangle.push_back(i == j ? (i < 3 ? 100e6 : 60e6) + 20e6 * random.uniform()
                                      : 10e6 * random.uniform());
    return triangle;
}

TEST(Umat, GivesEveryConstantOfAnAnisotropicSoilItsPlace) {
    Random random;
    const std::vector<double> constants = triclinic(random);
    const Elasticity expected(constants);
    const Umat soil(settings("anisotropic", "", {{"properties", list(constants)}}));
    Batch b(soil, 100, true);
    std::vector<Tensor> strain;
    for (int64_t i = 0; i < b.count(); ++i) {
        strain.push_back(random.tensor(1e-3));
        b.set_strain(i, strain.back());
        b.set_stress_old(i, {1e5, 2e5, 3e5, 4e5, 5e5, 6e5});
    }
    ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
    for (int64_t i = 0; i < b.count(); ++i) {
        const Tensor more = expected.stress(strain[i]);
        for (int k = 0; k < 6; ++k) { // some ten roundings of stresses below 1 MPa
            EXPECT_NEAR(b.stress_at(i)[k], 1e5 * (k + 1) + more[k], 1e-8) << i << k;
            EXPECT_EQ(b.state[k][i], strain[i][k]) << "total strain";
        }
    }
    for (int column = 0; column < 6; ++column) {
        Tensor unit{};
        unit[column] = 1.0;
        const Tensor answer = expected.stress(unit);
        for (int row = 0; row < 6; ++row)
            EXPECT_NEAR(b.tangent[6 * row + column][7], answer[row], 1e-6) << row << column;
    }
}

TEST(Umat, BoundsTheSpeedOfWavesInEveryDirectionOfAnAnisotropicSoil) {
    Random random;
    double loosest = 0.0;
    for (int soil_number = 0; soil_number < 20; ++soil_number) {
        const std::vector<double> constants = triclinic(random);
        const Elasticity elasticity(constants);
        const Umat soil(settings("anisotropic", "", {{"properties", list(constants)}}));
        Batch b(soil, 1);
        ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
        double fastest = 0.0;
        for (int direction = 0; direction < 500; ++direction) {
            Direction n{random.uniform(), random.uniform(), random.uniform()};
            const double scale = length(n);
            for (double& component : n)
                component /= scale;
            fastest = std::max(fastest, elasticity.fastest_wave_modulus(n));
        }
        EXPECT_GE(b.modulus[0], fastest);
        loosest = std::max(loosest, b.modulus[0] / fastest);
        EXPECT_GT(b.shear_modulus[0], 0.0);
        EXPECT_LT(b.shear_modulus[0], b.modulus[0]);
    }
    EXPECT_LT(loosest, 1.5); // steps are shorter than need be by its root
}

TEST(Umat, StatesTheExactModuliOfAnIsotropicSoil) {
    const Umat soil(settings("awkward", "", {{"properties", isotropic}}));
    Batch b(soil, 9);
    ASSERT_EQ(b.update(), GAULT_OK);
    for (int64_t i = 0; i < b.count(); ++i) {
        EXPECT_NEAR(b.modulus[i], lame + 2.0 * shear, 1e-14 * lame * 10.0);
        EXPECT_NEAR(b.shear_modulus[i], shear, 1e-14 * shear * 10.0);
    }
}

TEST(Umat, GivesTheSameBitsOnEveryProcessorAndInEveryBatch) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "LeakSanitizer itself crashes over the thread-local data of the variants that are closed";
#endif
    std::vector<Tensor> first;
    for (const std::string& variant : variants())
        for (const int64_t together : {37, 1}) {
            Random random;
            const Umat soil(settings("anisotropic", "", {{"properties", list(triclinic(random))}}), variant);
            std::vector<Tensor> result;
            for (int64_t done = 0; done < 37; done += together) {
                Batch b(soil, together);
                for (int64_t i = 0; i < together; ++i) {
                    b.set_strain(i, random.tensor(1e-3));
                    b.set_stress_old(i, random.tensor(1e5));
                }
                ASSERT_EQ(b.update(), GAULT_OK);
                for (int64_t i = 0; i < together; ++i) {
                    result.push_back(b.stress_at(i));
                    result.push_back({b.modulus[i], b.shear_modulus[i], 0.0, 0.0, 0.0, 0.0});
                }
            }
            if (first.empty()) first = result;
            EXPECT_EQ(result, first) << variant;
        }
}

// ---- what the UMAT is told ------------------------------------------------------------------------------

constexpr int told = 42; // entries that echo.c overwrites

Settings echo(int more, Settings with = {}) {
    with["properties"] = isotropic;
    with["statev"] = told + more;
    return settings("echo", "", with);
}

TEST(Umat, IsToldWhatAbaqusTells) {
    const Umat soil(echo(0, {{"cmname", "Boom clay"}}));
    Batch b(soil, 2);
    b.set_dt(0.25);
    b.set_strain(1, {1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3});
    for (int k = 0; k < 6; ++k)
        b.state_old[k][1] = 0.01 * (k + 1); // the total strain
    b.input[0][1] = 0.125;
    ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
    const std::vector<double> expected{
        3,    3,     6,    told, 2,           // NDI NSHR NTENS NSTATV NPROPS
        -.25, -.25,  0.25, 0,    0,           // TIME(1) TIME(2), at the start of the step; DTIME TEMP DTEMP
        1,    1,     1,    1,    1,           // KINC KSTEP NOEL NPT LAYER
        1,    0.125, 1e10, 80,   72,          // KSPT CELENT PNEWDT, the length of CMNAME and the blanks in it
        'B',  1,     1,    1,    0,           // CMNAME DROT
        0,    0,     0,    1,    1,           // COORDS PREDEF DPRED, DFGRD is NaN
        0.01, 0.02,  0.03, 0.08, 0.12,  0.10, // STRAN 11 22 33 12 13 23
        1e-3, 2e-3,  3e-3, 8e-3, 12e-3, 10e-3}; // DSTRAN
    ASSERT_EQ(expected.size(), std::size_t{told});
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_DOUBLE_EQ(b.state[static_cast<std::size_t>(6) + i][1], expected[i]) << "STATEV " << i + 1;
}

TEST(Umat, IsNotDisturbedByWhatItDoesToItsArguments) {
    const Umat soil(echo(1));
    Batch b(soil, 3);
    for (int64_t i = 0; i < b.count(); ++i)
        b.set_strain(i, {1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0});
    for (int step = 1; step <= 2; ++step) {
        ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
        for (int64_t i = 0; i < b.count(); ++i) {
            EXPECT_DOUBLE_EQ(b.stress_at(i)[0], step * (lame + 2.0 * shear) * 1e-3);
            EXPECT_DOUBLE_EQ(b.stress_at(i)[3], step * 2.0 * shear * 1e-3);
            EXPECT_DOUBLE_EQ(b.state[0][i], step * 1e-3);
            EXPECT_DOUBLE_EQ(b.state[6 + told][i], step * (told + 1.0)) << "a state that is carried on";
        }
        b.advance();
    }
}

TEST(Umat, IsToldAStepOfANanosecondWhereThereIsNone) {
    const Umat soil(echo(0));
    Batch b(soil, 1);
    b.set_dt(0.0);
    ASSERT_EQ(b.update(), GAULT_OK);
    EXPECT_EQ(b.state[6 + 7][0], 1e-9);
}

TEST(Umat, StartsWithTheStateVariablesOfTheScene) {
    std::vector<double> initial;
    for (int i = 0; i < told + 2; ++i)
        initial.push_back(100.0 + i);
    const Umat soil(echo(2, {{"initial_statev", list(initial)}}));
    Batch b(soil, 3);
    ASSERT_EQ(b.start(), GAULT_OK) << b.error.text;
    for (int64_t i = 0; i < b.count(); ++i)
        for (int k = 0; k < told + 2; ++k)
            EXPECT_EQ(b.state_old[static_cast<std::size_t>(6 + k)][i], 100.0 + k);
}

// Tensors go to the host in its own order and as tensor shear, so that it can rotate them, and come back as
// they were.
TEST(Umat, KeepsTensorsOfStateWhereTheHostRotatesThem) {
    std::vector<double> initial(told, 0.0);
    for (int i = 0; i < 14; ++i) // two scalars about two tensors
        initial.push_back(10.0 * (i + 1));
    const Umat soil(echo(14, {{"initial_statev", list(initial)},
                              {"stress_statev", list({told + 2.0})},
                              {"strain_statev", list({told + 9.0})}}));
    uint32_t count = 0;
    const gault_state* states = soil.api.instance_states(soil.instance.self(), &count);
    ASSERT_EQ(count, 1u + told + 4u);
    EXPECT_EQ(states[0].shape, gault_shape{GAULT_SYMMETRIC});
    EXPECT_EQ(states[told + 1].shape, gault_shape{GAULT_SCALAR});
    EXPECT_STREQ(states[told + 1].name, "statev_43");
    EXPECT_EQ(states[told + 2].shape, gault_shape{GAULT_SYMMETRIC});
    EXPECT_STREQ(states[told + 2].name, "statev_44_to_49");
    EXPECT_EQ(states[told + 4].shape, gault_shape{GAULT_SYMMETRIC});

    Batch b(soil, 1);
    ASSERT_EQ(b.start(), GAULT_OK) << b.error.text;
    const auto entry = [&](int i) { return b.state_old[static_cast<std::size_t>(6 + told + i)][0]; };
    const double expected[] = {10, 20, 30,  40,  50, 70, 60,
                               80, 90, 100, 110, 60, 70, 65}; // 23 before 13, halves
    for (int i = 0; i < 14; ++i)
        EXPECT_EQ(entry(i), expected[i]) << i;

    ASSERT_EQ(b.update(), GAULT_OK); // echo.c adds its index to each
    b.advance();
    const double more[] = {1, 2, 3, 4, 5, 7, 6, 8, 9, 10, 11, 6, 7, 6.5};
    const double base[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5, 0.5, 0.5};
    for (int i = 0; i < 14; ++i)
        EXPECT_DOUBLE_EQ(entry(i), expected[i] + told * base[i] + more[i]) << i;
}

// ---- plasticity, in Fortran -----------------------------------------------------------------------------

class UmatInFortran : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::ifstream(umats + "von_mises.so")) GTEST_SKIP() << "built without a Fortran compiler";
    }
    static constexpr double E = 50e6, nu = 0.3, yield = 100e3, hardening = 5e6;
    static Settings von_mises() {
        return settings("von_mises", "", {{"properties", list({E, nu, yield, hardening})}, {"statev", 1}});
    }
};

// Beyond yield the slope is E H / (E + H); back, it is E. The path is proportional, for which backward Euler
// is exact.
TEST_F(UmatInFortran, YieldsAndHardensInUniaxialTension) {
    const Umat soil(von_mises());
    Laboratory lab(soil, {});
    double reached = 0.0;
    for (int step = 1; step <= 100; ++step) {
        lab.triaxial_drained(1e-4, 0.0);
        const double strain = 1e-4 * step, first = yield / E, slope = E * hardening / (E + hardening);
        reached = strain < first ? E * strain : yield + slope * (strain - first);
        ASSERT_NEAR(lab.stress()[0], reached, 1e-8 * yield) << step; // as near as the laboratory drives
        ASSERT_NEAR(lab.state(6), strain < first ? 0.0 : (reached - yield) / hardening, 1e-10) << step;
    }
    lab.triaxial_drained(-1e-4, 0.0);
    EXPECT_NEAR(lab.stress()[0], reached - E * 1e-4, 1e-8 * yield);
}

// tau = y / sqrt(3) + gamma_p H / 3, gamma = tau / G + gamma_p: engineering shear on either side.
TEST_F(UmatInFortran, YieldsInEachShearAtItsShareOfTheYieldStress) {
    const double G = 0.5 * E / (1.0 + nu), first = yield / std::sqrt(3.0) / G;
    for (std::size_t component = 3; component < 6; ++component) {
        const Umat soil(von_mises());
        Batch b(soil, 1);
        const double gamma = 3.0 * first, slope = 1.0 / (1.0 / G + 3.0 / hardening);
        b.strain[component][0] = 0.5 * gamma;
        ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
        const double expected = yield / std::sqrt(3.0) + slope * (gamma - first);
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_NEAR(b.stress[k][0], k == component ? expected : 0.0, 1e-13 * yield * 10.0)
                << component << k;
    }
}

std::vector<Tensor> strains_beyond_yield() {
    Random random;
    std::vector<Tensor> all;
    for (int i = 0; i < 200; ++i)
        all.push_back(random.tensor(5e-3));
    return all;
}

// Central differences of 1e-7: their error is that of the curvature, (1e-7 / 2e-3)^2, and of rounding, 1e-16
// / 1e-7 of stresses of E 5e-3 over stiffnesses of E.
TEST_F(UmatInFortran, HandsOnItsConsistentTangent) {
    const Umat soil(von_mises());
    int plastic = 0;
    for (const Tensor& strain : strains_beyond_yield()) {
        Batch b(soil, 13, true);
        for (int64_t i = 0; i < 13; ++i)
            b.set_strain(i, strain);
        for (int k = 0; k < 6; ++k)
            b.strain[k][1 + 2 * k] += 1e-7, b.strain[k][2 + 2 * k] -= 1e-7;
        ASSERT_EQ(b.update(), GAULT_OK) << b.error.text;
        plastic += b.state[6][0] > 0.0;
        for (int row = 0; row < 6; ++row)
            for (int column = 0; column < 6; ++column) {
                const double slope = (b.stress[row][1 + 2 * column] - b.stress[row][2 + 2 * column]) / 2e-7;
                ASSERT_NEAR(b.tangent[6 * row + column][0], slope, 1e-6 * E) << row << column;
            }
    }
    EXPECT_GT(plastic, 150);
}

// While it yields, DDSDDE is far below the elastic stiffness that waves travel with as soon as it unloads.
TEST_F(UmatInFortran, StatesItsElasticModuliWhileItYields) {
    const Umat soil(von_mises());
    const double G = 0.5 * E / (1.0 + nu), M = 2.0 * G * (1.0 - nu) / (1.0 - 2.0 * nu);
    for (const Tensor& strain : strains_beyond_yield()) {
        Batch b(soil, 1);
        b.set_strain(0, strain);
        ASSERT_EQ(b.update(), GAULT_OK);
        EXPECT_LE(b.modulus[0], M * (1.0 + 1e-12)); // of the step: its own DDSDDE
        b.advance();
        b.set_strain(0, {});
        b.set_dt(0.0); // as the host asks at rest
        ASSERT_EQ(b.update(), GAULT_OK);
        EXPECT_NEAR(b.modulus[0], M, 1e-12 * M);
        EXPECT_NEAR(b.shear_modulus[0], G, 1e-12 * G);
    }
}

TEST_F(UmatInFortran, RefusesAnInitialStressBeyondItsYieldSurface) {
    const Umat soil(von_mises());
    for (const double q : {0.99 * yield, 1.01 * yield}) {
        Batch b(soil, 1);
        b.set_stress_old(0, {-200e3 - q, -200e3, -200e3, 0.0, 0.0, 0.0});
        EXPECT_EQ(b.start(), q < yield ? GAULT_OK : GAULT_FAILED) << b.error.text;
        EXPECT_EQ(contains(b.error.text, "changes the initial stress"), q > yield) << b.error.text;
    }
}

// The error of backward Euler on a path that turns; order 1.
TEST_F(UmatInFortran, ConvergesWithTheStep) {
    const Umat soil(von_mises());
    const auto end = [&](int steps) {
        Batch b(soil, 1);
        for (const Tensor& leg :
             {Tensor{8e-3, -4e-3, -4e-3, 0.0, 0.0, 0.0}, Tensor{0.0, 0.0, 0.0, 8e-3, 4e-3, 0.0}})
            for (int n = 0; n < steps; ++n) {
                Tensor part = leg;
                for (double& e : part)
                    e /= steps;
                b.set_strain(0, part);
                if (b.update() != GAULT_OK) throw std::runtime_error(b.error.text);
                b.advance();
            }
        return b.stress_at(0);
    };
    const auto distance = [](const Tensor& a, const Tensor& b) {
        double sum = 0.0;
        for (int k = 0; k < 6; ++k)
            sum += (a[k] - b[k]) * (a[k] - b[k]);
        return std::sqrt(sum);
    };
    const Tensor fine = end(20000);
    const double order = std::log2(distance(end(100), fine) / distance(end(200), fine));
    EXPECT_NEAR(order, 1.0, 0.1);
}

// ---- what a UMAT may do wrong ---------------------------------------------------------------------------

Settings awkward(const std::string& symbol, int statev = 2) {
    return settings("awkward", symbol, {{"properties", list({lame, shear, 1e-4})}, {"statev", statev}});
}

TEST(Umat, ThatAsksForAShorterStepGetsIt) {
    const Umat soil(awkward("cautious_"));
    Batch b(soil, 3);
    b.strain[0][1] = 1e-3;
    ASSERT_EQ(b.update(), GAULT_RETRY);
    EXPECT_EQ(b.suggested(), 0.25);
    int pieces = 4; // as a host divides
    for (;; pieces *= 2) {
        b.strain[0][1] = 1e-3 / pieces;
        b.set_dt(1.0 / pieces);
        if (b.update() == GAULT_OK) break;
    }
    EXPECT_EQ(pieces, 16); // into increments of 1e-4 or less
    for (int n = 1; n <= pieces; ++n) {
        ASSERT_EQ(b.update(), GAULT_OK);
        b.advance();
    }
    EXPECT_NEAR(b.stress_old[0][1], (lame + 2.0 * shear) * 1e-3, 1e-8);
}

TEST(Umat, ThatIsNeverContentKeepsAsking) {
    const Umat soil(awkward("never_content_"));
    Batch b(soil, 1);
    ASSERT_EQ(b.start(), GAULT_OK);
    for (double strain = 1e-2; strain > 1e-7; strain *= 0.5) {
        b.strain[2][0] = strain;
        ASSERT_EQ(b.update(), GAULT_RETRY);
        EXPECT_EQ(b.suggested(), 0.5);
    }
    b.set_dt(0.0);
    ASSERT_EQ(b.update(), GAULT_FAILED); // nothing is shorter
    EXPECT_TRUE(contains(b.error.text, "PNEWDT")) << b.error.text;
}

TEST(Umat, WithoutAFiniteResultFailsAtItsPoint) {
    EXPECT_TRUE(
        contains(failure(awkward("not_finite_"), 1e-3), "not_finite_ of awkward.so returned a stress"));
    EXPECT_TRUE(contains(failure(awkward("not_finite_state_"), 1e-3), "STATEV(2) that is not finite"));
    EXPECT_TRUE(
        contains(failure(awkward("not_finite_tangent_"), 1e-3, 0.0, true), "DDSDDE that is not finite"));
}

TEST(Umat, IsNotCalledWithAStrainThatIsNotFinite) {
    EXPECT_TRUE(contains(failure(awkward("umat_"), std::nan("")), "the strain is not finite"));
    EXPECT_TRUE(contains(failure(awkward("umat_"), HUGE_VAL), "the strain is not finite"));
}

TEST(Umat, ThatNeedsMoreThanItHasFailsRatherThanGuesses) {
    EXPECT_TRUE(
        contains(failure(awkward("wants_more_properties_"), 1e-3), "no failure")); // strain 22 is 0 there
    const Umat soil(awkward("wants_more_properties_"));
    Batch b(soil, 1);
    b.strain[1][0] = 1e-3;
    ASSERT_EQ(b.update(), GAULT_FAILED);
    EXPECT_TRUE(contains(b.error.text, "further properties")) << b.error.text;
    EXPECT_TRUE(contains(refused_start(awkward("wants_the_gradient_"), 0.0), "deformation gradient"));
    EXPECT_TRUE(
        contains(refused_start(awkward("oversteps_"), 0.0), "wrote to STATEV(3), which is beyond 'statev'"));
    EXPECT_TRUE(contains(refused_start(awkward("oversteps_", 0), 0.0), "wrote to STATEV(1)"));
}

TEST(Umat, ThatComputesStressFromTotalStrainCannotStartFromAStress) {
    EXPECT_EQ(refused_start(awkward("total_"), 0.0), "accepted");
    EXPECT_TRUE(contains(refused_start(awkward("total_"), -100e3), "computes stress from total strain"));
}

TEST(Umat, WithoutATangentIsRefusedAtTheStart) {
    EXPECT_TRUE(contains(refused_start(awkward("without_tangent_"), 0.0), "DDSDDE without stiffness"));
}

TEST(Umat, ThatCallsXitIsLeftAndFailsAtItsPoint) {
    for (int again = 0; again < 3; ++again)
        EXPECT_TRUE(contains(failure(awkward("exits_"), 1e-3), "stopped by calling XIT"));
    const Umat soil(awkward("exits_")); // and the next call is a call as any
    Batch b(soil, 1);
    b.strain[0][0] = -1e-3;
    EXPECT_EQ(b.update(), GAULT_OK);
}

TEST(Umat, SaysWithStdbAbqerrWhyItStops) {
    testing::internal::CaptureStderr();
    const std::string text = failure(awkward("reports_"), 1e-3);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(contains(text, "stopped by calling XIT")) << text;
    EXPECT_EQ(said, "UMAT: step 7 of 11: 0.001 in SAND    \n");
}

int most_at_a_time(bool thread_safe) {
    Settings with = awkward("crowded_");
    with["thread_safe"] = thread_safe;
    const Umat soil(with), same_library(with);
    std::atomic<int> most{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            Batch b(t % 2 ? soil : same_library, 64);
            for (int n = 0; n < 10; ++n) {
                EXPECT_EQ(b.update(), GAULT_OK);
                for (int64_t i = 0; i < b.count(); ++i)
                    most = std::max<int>(most, static_cast<int>(b.state[6][i]));
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    return most;
}

// The count of the library only grows, so the order of the two matters.
TEST(Umat, IsCalledByOneThreadAtATimeUnlessItIsDeclaredSafe) {
    EXPECT_EQ(most_at_a_time(false), 1);
    EXPECT_GT(most_at_a_time(true), 1);
}

// ---- libraries that cannot be used ----------------------------------------------------------------------

std::string refusal(const std::string& parameter, const Settings& with) {
    try {
        create(with);
    } catch (const Invalid& e) {
        EXPECT_EQ(e.parameter, parameter) << e.what();
        return e.what();
    }
    return "accepted";
}

TEST(UmatLibrary, ThatIsMissingIsNamedWithThePlacesThatWereSearched) {
    EXPECT_EQ(refusal("library", {{"library", "/nowhere/sand.so"}}),
              "is not found; looked for /nowhere/sand.so");
    ::setenv("GAULT_UMAT_PATH", "/one::/two", 1);
    const std::string text = refusal("library", {{"library", "sand.so"}});
    ::unsetenv("GAULT_UMAT_PATH");
    EXPECT_TRUE(contains(text, "./sand.so, /one/sand.so, /two/sand.so, ")) << text;
    EXPECT_TRUE(contains(text, "/../umat/sand.so")) << text;
    EXPECT_EQ(refusal("library", {{"library", ""}}), "is empty; it is the name of a shared library");
}

TEST(UmatLibrary, IsFoundBesideThePluginsByEveryVariant) {
    for (const std::string& variant : variants())
        EXPECT_NO_THROW(create({{"library", "test/awkward.so"}}, variant));
}

TEST(UmatLibrary, IsFoundOnItsSearchPath) {
    const std::string folder = umats.substr(0, umats.size() - 1);
    EXPECT_NE(refusal("library", {{"library", "echo.so"}}), "accepted");
    ::setenv("GAULT_UMAT_PATH", ("/nowhere:" + folder).c_str(), 1);
    EXPECT_EQ(refusal("library", {{"library", "echo.so"}}), "accepted");
    ::unsetenv("GAULT_UMAT_PATH");
}

TEST(UmatLibrary, ThatIsNoneIsSaidToBe) {
    const std::string text = refusal("library", {{"library", GAULT_SOURCE_DIR "/LICENSE"}});
    EXPECT_TRUE(contains(text, "cannot be opened")) << text;
    EXPECT_TRUE(contains(text, "LICENSE")) << text;
}

TEST(UmatLibrary, ThatWantsXitIsTold) {
    const std::string text = refusal("library", settings("unlinked"));
    EXPECT_TRUE(contains(text, "it wants 'xit_'")) << text;
    EXPECT_TRUE(contains(text, "abaqus_stub.c")) << text;
}

TEST(UmatLibrary, WithoutTheSymbolSaysWhatItIsUsuallyCalled) {
    const std::string text = refusal("symbol", settings("echo", "UMAT"));
    EXPECT_TRUE(contains(text, "'UMAT' is not in the library")) << text;
    EXPECT_TRUE(contains(text, "'umat_'")) << text;
    EXPECT_TRUE(contains(text, "undefined symbol: UMAT")) << text;
}

TEST(UmatParameters, ThatDoNotFitOneAnotherAreRefused) {
    const auto with = [](int statev, Settings more) {
        more["statev"] = statev;
        return settings("echo", "", more);
    };
    EXPECT_EQ(refusal("initial_statev", with(3, {{"initial_statev", list({1.0})}})),
              "has 1 number; 'statev' says 3");
    EXPECT_TRUE(contains(refusal("stress_statev", with(7, {{"stress_statev", list({3.0})}})),
                         "3 is not the index of the first of six among 7"));
    EXPECT_TRUE(contains(refusal("stress_statev", with(0, {{"stress_statev", list({1.0})}})),
                         "first of six among 0"));
    EXPECT_TRUE(
        contains(refusal("strain_statev", with(9, {{"strain_statev", list({1.5})}})), "first of six"));
    EXPECT_TRUE(contains(
        refusal("strain_statev", with(12, {{"stress_statev", list({1.0})}, {"strain_statev", list({6.0})}})),
        "the six from 6 on share one with another"));
    EXPECT_TRUE(contains(refusal("cmname", with(0, {{"cmname", std::string(81, 'x')}})), "80 characters"));
}

TEST(RateDependentUmat, TellsTheHostToFollowTime) {
    const Component plain = create(awkward("umat_"));
    const Component creeps{"umat", GAULT_MATERIAL, "umat_rate_dependent", awkward("umat_")};
    EXPECT_EQ(plain.api<gault_material_api>().flags & GAULT_RATE_DEPENDENT, 0u);
    EXPECT_NE(creeps.api<gault_material_api>().flags & GAULT_RATE_DEPENDENT, 0u);
    uint32_t count = 0;
    creeps.api<gault_material_api>().instance_states(creeps.self(), &count);
    EXPECT_EQ(count, 3u);
}

} // namespace
