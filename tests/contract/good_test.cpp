// A plugin in C serves the host like any other.
#include "core/base/aligned.hpp"
#include "core/registry/instance.hpp"
#include "core/registry/registry.hpp"

#include <gtest/gtest.h>

using namespace gault::core;

namespace {

Parameters parameters(double stiffness, double growth, double poisson_ratio) {
    Parameters p;
    p.where = {"scene.yaml", 2, 3};
    int line = 3;
    for (const double value : {stiffness, growth, poisson_ratio}) {
        gault_value v{};
        v.real = value;
        v.text = "";
        v.count = 1;
        p.values.push_back(v);
        p.locations.push_back({"scene.yaml", line++, 20});
    }
    return p;
}

// One batch of eight points, of which three matter.
struct Batch {
    Column columns[19] = {};
    gault_points points{};
    gault_error error{};

    Batch() {
        for (Column& c : columns)
            c.assign(GAULT_LANES, 0.0);
        points.size = sizeof points;
        points.count = 3;
        points.padded = GAULT_LANES;
        for (int i = 0; i < 6; ++i) {
            points.strain[i] = columns[i].data();
            points.stress_old[i] = columns[6 + i].data();
            points.stress[i] = columns[12 + i].data();
        }
        states.assign(2 * GAULT_LANES, 0.0);
        old_state = states.data();
        state = states.data() + GAULT_LANES;
        points.state_old = &old_state;
        points.state = &state;
        points.modulus = columns[18].data();
    }
    Batch(const Batch&) = delete;
    Column states;
    double *old_state, *state;
};

} // namespace

TEST(PluginInC, ObeysHookesLawAndRemembersThePressure) {
    const Registry registry({CONTRACT_DIR "/good"});
    const Instance soil(registry.find(GAULT_MATERIAL, "hypoelastic"), parameters(100e6, 0.0, 0.25));
    Batch batch;
    for (int axis = 0; axis < 3; ++axis)
        batch.columns[axis][1] = -1e-3; // isotropic compression of the second point
    batch.columns[3][2] = 1e-3;         // shear of the third
    ASSERT_EQ(soil.api<gault_material_api>().update(soil.self(), &batch.points, &batch.error), +GAULT_OK);
    EXPECT_DOUBLE_EQ(batch.points.stress[0][0], 0.0);
    EXPECT_NEAR(batch.points.stress[0][1], -200e3, 1e-6); // 3 K = E / (1 - 2 nu)
    EXPECT_NEAR(batch.points.state[0][1], 200e3, 1e-6);
    EXPECT_NEAR(batch.points.stress[3][2], 80e3, 1e-6); // 2 G = E / (1 + nu)
    EXPECT_NEAR(batch.points.modulus[0], 120e6, 1e-3);  // lame + 2 G
}

TEST(PluginInC, NamesTheParameterThatItRefuses) {
    const Registry registry({CONTRACT_DIR "/good"});
    try {
        const Instance soil(registry.find(GAULT_MATERIAL, "hypoelastic"), parameters(100e6, 2000.0, 0.45));
        ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(), "scene.yaml:4:20: material 'hypoelastic': growth: 2000 is too much for a "
                               "Poisson's ratio above 0.4");
    }
}

TEST(PluginInC, NamesThePointThatFailed) {
    const Registry registry({CONTRACT_DIR "/good"});
    const Instance soil(registry.find(GAULT_MATERIAL, "hypoelastic"), parameters(100e6, 0.0, 0.25));
    Batch batch;
    batch.columns[0][2] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(soil.api<gault_material_api>().update(soil.self(), &batch.points, &batch.error), +GAULT_FAILED);
    EXPECT_EQ(batch.error.point, 2);
    EXPECT_STREQ(batch.error.text, "the stress is not finite");
}

TEST(PluginInC, IsDescribedFromTheFileAlone) {
    setenv("GAULT_ISA", "baseline", 1);
    const Registry registry({CONTRACT_DIR "/good"});
    const std::string text = describe(registry.find(GAULT_MATERIAL, "hypoelastic"));
    EXPECT_TRUE(text.starts_with("material hypoelastic 1.2.0\n    Isotropic, stiffer under pressure.\n"))
        << text;
    EXPECT_NE(text.find("file       " CONTRACT_DIR "/good/hypoelastic.so\n"), std::string::npos) << text;
    EXPECT_NE(
        text.find("stiffness      E0      Pa    required  > 0          Young's modulus without pressure.\n"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("poisson_ratio  nu      1     0.25      > -1, < 0.5  Poisson's ratio.\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("borne_pressure  Pa    scalar  0        0     inf  Largest pressure so far.\n"),
              std::string::npos)
        << text;
}
