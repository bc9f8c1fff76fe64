#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <set>
#include <thread>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6;

std::string message(const std::function<void()>& f) {
    try {
        f();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

// A body strained by 1 % along y in one step.
void squeeze(Body& body, double strain = -0.01) {
    body.motion->deform(body.field([&](double, double y) {
        return std::array{0.0, strain * y};
    }),
                        {1.0, 1.0});
}

class EveryFrame : public testing::TestWithParam<Frame> {
  protected:
    TestMaterial soil{lame, shear};
    Shape shape() const {
        Shape form;
        form.frame = GetParam();
        return form;
    }
    SmallScene s{shape()};
};

TEST_P(EveryFrame, RepeatsAnUpdateInPiecesWhenTheModelAsksForSmallerSteps) {
    std::set<double> largest; // strain increment of an accepted call
    soil.update = [&](gault_points& p, gault_error&) {
        if (p.dt == 0.0) return soil.elastic(p);
        const double strain = std::abs(p.strain[1][0]);
        if (strain > 0.003) {
            p.suggest = 0.5;
            return gault_status(GAULT_RETRY);
        }
        largest.insert(std::round(strain * 1e8));
        EXPECT_NEAR(p.dt * 0.01005, strain, 1e-5) << "time is divided as strain is";
        return soil.elastic(p);
    };
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body);
    const double strain = -0.01 / 0.995;
    EXPECT_EQ(largest, std::set<double>{std::round(-strain / 4.0 * 1e8)})
        << "halves were too large, quarters not";
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
        ASSERT_NEAR(c.stress[1][slot], (lame + 2 * shear) * strain, 1e-9 * lame);
        ASSERT_NEAR(c.stress[0][slot], lame * strain, 1e-9 * lame);
    });
}

TEST_P(EveryFrame, CarriesStatesFromPieceToPiece) {
    soil.states = {{"count", "1", "", GAULT_SCALAR, 0, 5.0, 0.0, 100.0}};
    soil.update = [&](gault_points& p, gault_error&) {
        if (p.dt > 0.15) {
            p.suggest = 0.11; // a tenth: ten pieces
            return gault_status(GAULT_RETRY);
        }
        soil.elastic(p);
        for (int64_t i = 0; i < p.count; ++i)
            p.state[0][i] = p.state_old[0][i] + 1.0;
        return gault_status(GAULT_OK);
    };
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body);
    body.each_point(
        [&](PointColumns& c, std::size_t slot, const PointRecord&) { ASSERT_EQ(c.state[0][slot], 15.0); });
}

TEST_P(EveryFrame, GivesUpAfterAThousandPieces) {
    soil.update = [&](gault_points& p, gault_error&) {
        return p.dt == 0.0 ? soil.elastic(p) : gault_status(GAULT_RETRY);
    };
    s.add(soil, 1600.0);
    Body body(s.scene);
    EXPECT_THROW(squeeze(body), RunError);
    const std::string text = message([&] { squeeze(body); });
    EXPECT_NE(text.find("divided more than 1024 times"), std::string::npos) << text;
}

TEST_P(EveryFrame, NamesThePointThatFailedAndSaysWhy) {
    soil.update = [&](gault_points& p, gault_error& e) {
        if (p.dt == 0.0) return soil.elastic(p);
        e.point = 2;
        std::strcpy(e.text, "the soil has had enough");
        return gault_status(GAULT_FAILED);
    };
    s.add(soil, 1600.0, "layer");
    Body body(s.scene);
    const PointRecord third = body.motion->record(0, 2);
    const std::string where = body.motion->where(0, 2), text = message([&] { squeeze(body, -1e-9); });
    EXPECT_EQ(text, where + ": the soil has had enough");
    EXPECT_NE(where.find("point " + std::to_string(body.model.points[0].identity(2)) + " of 'layer' at ("),
              std::string::npos);
    EXPECT_GT(third.reference[0], 0.0);
}

TEST_P(EveryFrame, SaysThatNoReasonWasGiven) {
    soil.update = [&](gault_points& p, gault_error&) {
        return p.dt == 0.0 ? soil.elastic(p) : gault_status(GAULT_FAILED);
    };
    s.add(soil, 1600.0);
    Body body(s.scene);
    EXPECT_EQ(message([&] { squeeze(body); }), "material 'soil': the model gave no result and no reason");
}

TEST_P(EveryFrame, SaysThatAPointStrainedTooMuchInAStep) {
    s.add(soil, 1600.0);
    Body body(s.scene);
    const std::string text = message([&] { squeeze(body, 0.3); });
    EXPECT_NE(text.find("unstable: point 0 of 'soil' at ("), std::string::npos) << text;
}

TEST_P(EveryFrame, OffersDensityAndVolumeRatio) {
    std::vector<std::array<double, 2>> seen;
    soil.inputs = {"density", "volume_ratio"};
    soil.update = [&](gault_points& p, gault_error&) {
        for (int64_t i = 0; p.dt > 0.0 && i < p.count; ++i)
            seen.push_back({p.input[0][i], p.input[1][i]});
        return soil.elastic(p);
    };
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body);
    squeeze(body);
    ASSERT_EQ(seen.size(), 2u * 12 * 16);
    // a displacement gradient of -1 % of the first length in the total frame, of the present one in the
    // updated
    const double second = GetParam() == Frame::total ? 0.98 : 0.99 * 0.99;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const double ratio = i < seen.size() / 2 ? 0.99 : second;
        EXPECT_NEAR(seen[i][1], ratio, 2e-4); // in the updated frame the nodes of the second step have moved
        EXPECT_NEAR(seen[i][0], 1600.0 / seen[i][1], 1e-9);
    }
}

TEST_P(EveryFrame, TellsTheSizeOfEveryPointsCell) {
    std::vector<double> size_at_rest, size;
    soil.inputs = {"characteristic_length"};
    soil.start = [&](gault_points& p, gault_error&) {
        size_at_rest.insert(size_at_rest.end(), p.input[0], p.input[0] + p.count);
        return gault_status(GAULT_OK);
    };
    soil.update = [&](gault_points& p, gault_error&) {
        if (p.dt > 0.0) size.insert(size.end(), p.input[0], p.input[0] + p.count);
        return soil.elastic(p);
    };
    s.scene.axes = {{{3, 2.0}, {1, 1.0}}}; // cells of 1/7, 2/7 and 4/7 m by 1 m
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body, 0.0);
    ASSERT_EQ(size.size(), 3u * 16);
    for (std::size_t i = 0; i < size.size(); ++i)
        EXPECT_NEAR(size[i], std::sqrt((1 << (i / 16)) / 7.0), 1e-14) << i;
    EXPECT_EQ(size, size_at_rest);
}

// The height of a radial cell is a convention.
TEST_P(EveryFrame, TellsTheSizeOfARadialCellAlongTheRadius) {
    std::vector<double> size;
    soil.inputs = {"characteristic_length"};
    soil.start = [&](gault_points& p, gault_error&) {
        size.insert(size.end(), p.input[0], p.input[0] + p.count);
        return gault_status(GAULT_OK);
    };
    Shape ring = shape();
    ring.symmetry = Symmetry::radial;
    ring.lower = {1.0, 0.0};
    ring.upper = {2.0, 1.0};
    ring.axes = {{{3, 2.0}, {1, 1.0}}}; // cells of 1/7, 2/7 and 4/7 m
    ring.per_cell = 2;
    SmallScene radial(ring);
    radial.add(soil, 1600.0);
    Body body(radial.scene);
    std::set<double> lengths;
    for (const double length : size)
        lengths.insert(std::round(7e12 * length));
    EXPECT_EQ(lengths, (std::set<double>{1e12, 2e12, 4e12}));
}

// F is dragged along by the motion, also in three pieces; the stress is not rotated for such a material.
TEST_P(EveryFrame, GivesTheDeformationGradientToFiniteStrainMaterials) {
    std::array<double, 9> before{}, after{};
    bool in_pieces = false;
    soil.flags = GAULT_FINITE_STRAIN;
    soil.update = [&](gault_points& p, gault_error&) {
        if (p.dt > 0.0 && p.dt < 1.0) in_pieces = true;
        if (p.dt == 1.0 && in_pieces) return gault_status(GAULT_OK);
        for (int k = 0; k < 9; ++k) {
            before[k] = p.F_old[k][0];
            after[k] = p.F_new[k][0];
        }
        for (int k = 0; k < 6; ++k)
            for (int64_t i = 0; i < p.count; ++i)
                p.stress[k][i] = p.stress_old[k][i];
        if (p.modulus) std::fill_n(p.modulus, p.count, 1.0), std::fill_n(p.shear_modulus, p.count, 0.1);
        return gault_status(GAULT_OK);
    };
    s.scene.solver.stress_update = StressUpdate::usf; // the grid of the updated frame stays where it is
    s.scene.initial_stress.vertical = 100e3;
    s.scene.initial_stress.k0 = 0.3;
    s.add(soil, 1600.0);
    Body body(s.scene);
    const double step[2][2] = {{0.01, 0.03}, {-0.05, 0.02}};
    const VectorField v = body.field([&](double x, double y) {
        return std::array{step[0][0] * x + step[0][1] * y, step[1][0] * x + step[1][1] * y};
    });
    body.motion->deform(v, {1.0, 1.0});
    body.motion->deform(v, {2.0, 1.0});
    const auto expect_gradient = [](const std::array<double, 9>& f, double xx, double xy, double yx,
                                    double yy) {
        const double expected[9] = {xx, xy, 0, yx, yy, 0, 0, 0, 1};
        for (int k = 0; k < 9; ++k)
            EXPECT_NEAR(f[k], expected[k], 1e-14) << k;
    };
    expect_gradient(before, 1.01, 0.03, -0.05, 1.02);
    if (GetParam() == Frame::total)
        expect_gradient(after, 1.02, 0.06, -0.10, 1.04); // the sum of two displacements
    else
        expect_gradient(after, 1.01 * 1.01 - 0.03 * 0.05, 0.03 * (1.01 + 1.02), -0.05 * (1.01 + 1.02),
                        1.02 * 1.02 - 0.03 * 0.05);
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
        ASSERT_EQ(c.stress[0][slot], -30e3);
        ASSERT_EQ(c.stress[1][slot], -100e3);
        ASSERT_EQ(c.stress[3][slot], 0.0);
    });
}

TEST_P(EveryFrame, InterpolatesTheDeformationGradientBetweenPieces) {
    std::vector<double> starts, ends;
    soil.flags = GAULT_FINITE_STRAIN;
    soil.update = [&](gault_points& p, gault_error&) {
        if (p.dt == 1.0) {
            p.suggest = 0.34; // three pieces
            return gault_status(GAULT_RETRY);
        }
        if (p.dt > 0.0) {
            starts.push_back(p.F_old[4][0]);
            ends.push_back(p.F_new[4][0]);
        }
        return soil.elastic(p);
    };
    s.scene.axes = {{{1, 1.0}, {1, 1.0}}};
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body, 0.03);
    ASSERT_EQ(starts.size(), 3u);
    for (int piece = 0; piece < 3; ++piece) {
        EXPECT_NEAR(starts[piece], 1.0 + 0.01 * piece, 1e-14);
        EXPECT_NEAR(ends[piece], 1.01 + 0.01 * piece, 1e-14);
    }
}

TEST_P(EveryFrame, CallsAModelWithGlobalStateFromOneThreadAtATime) {
    std::atomic<int> inside = 0, most = 0, calls = 0;
    soil.flags = GAULT_ONE_AT_A_TIME;
    soil.update = [&](gault_points& p, gault_error&) {
        most = std::max<int>(most, ++inside);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ++calls;
        --inside;
        return soil.elastic(p);
    };
    s.scene.axes = {{{2, 1.0}, {16, 1.0}}};
    s.add(soil, 1600.0);
    Body body(s.scene, 4);
    squeeze(body);
    EXPECT_EQ(most, 1);
    EXPECT_EQ(calls, 16) << "a batch a row";
}

TEST_P(EveryFrame, HoldsAsManyStatesAsAreDeclared) {
    soil.states.assign(20, {"fabric", "1", "", GAULT_SYMMETRIC, 0, 0.5, -1.0, 2e3}); // 120 components
    soil.update = [&](gault_points& p, gault_error&) {
        if (p.dt > 0.6) return gault_status(GAULT_RETRY); // in two pieces
        soil.elastic(p);
        for (int k = 0; k < 120; ++k)
            p.state[k][0] = p.state_old[k][0] + k;
        return gault_status(GAULT_OK);
    };
    soil.flags = GAULT_FINITE_STRAIN; // whose states are not rotated
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body);
    for (int k = 0; k < 120; ++k) {
        EXPECT_EQ(body.model.points[0].columns().state[k][0], 0.5 + 2 * k);
        EXPECT_EQ(body.model.points[0].columns().state[k][1], 0.5);
    }
}

TEST_P(EveryFrame, HalvesAnIncrementWhereTheFractionIsNotANumber) {
    std::set<double> lengths;
    soil.update = [&](gault_points& p, gault_error&) {
        p.suggest = std::numeric_limits<double>::quiet_NaN();
        if (p.dt > 0.6) return gault_status(GAULT_RETRY);
        lengths.insert(p.dt);
        return soil.elastic(p);
    };
    s.add(soil, 1600.0);
    Body body(s.scene);
    squeeze(body);
    EXPECT_EQ(lengths, std::set<double>{0.5});
}

INSTANTIATE_TEST_SUITE_P(Frames, EveryFrame, testing::Values(Frame::total, Frame::updated),
                         [](const auto& instance) {
                             return instance.param == Frame::total ? "Total" : "Updated";
                         });

TEST(Material, RefusesAFieldThatTheHostDoesNotOffer) {
    TestMaterial soil(lame, shear);
    soil.inputs = {"densty"};
    SmallScene s{Shape{}};
    s.add(soil, 1600.0);
    const std::string text = message([&] { Body body(s.scene); });
    EXPECT_NE(text.find("scene.yaml:7:3: material 'soil' asks for the field 'densty'"), std::string::npos)
        << text;
    EXPECT_NE(text.find("did you mean 'density'?"), std::string::npos) << text;
}

TEST(Material, RefusesModuliThatSetNoTimeStep) {
    const auto refusal = [](double modulus, double shear_modulus) {
        TestMaterial soil(lame, shear);
        soil.update = [&](gault_points& p, gault_error&) {
            soil.elastic(p);
            if (p.modulus) p.modulus[5] = modulus, p.shear_modulus[5] = shear_modulus;
            return gault_status(GAULT_OK);
        };
        SmallScene s{Shape{}};
        s.add(soil, 1600.0);
        return message([&] {
            Model model = build_model(s.scene);
            ExplicitSolver solver(s.scene, model, 1);
        });
    };
    EXPECT_EQ(refusal(std::nan(""), shear),
              "material 'soil': point 5 has the P-wave modulus nan Pa; it must be positive and finite");
    EXPECT_EQ(refusal(0.0, shear),
              "material 'soil': point 5 has the P-wave modulus 0 Pa; it must be positive and finite");
    EXPECT_EQ(refusal(lame, HUGE_VAL),
              "material 'soil': point 5 has the shear modulus inf Pa; it must be finite and not negative");
    EXPECT_EQ(refusal(lame, -1.0),
              "material 'soil': point 5 has the shear modulus -1 Pa; it must be finite and not negative");
    EXPECT_EQ(refusal(lame, 0.0), "") << "a fluid";
}

TEST(Material, StartsFromTheInitialStressAndMayRefuseIt) {
    TestMaterial soil(lame, shear);
    soil.states = {{"memory", "Pa", "", GAULT_SCALAR, 0, 0.0, 0.0, 1e9}};
    soil.start = [](gault_points& p, gault_error& e) {
        for (int64_t i = 0; i < p.count; ++i)
            p.state[0][i] = -p.stress[1][i];
        if (-p.stress_old[1][0] < 60e3) return gault_status(GAULT_OK);
        std::strcpy(e.text, "too much for this soil");
        return gault_status(GAULT_FAILED);
    };
    SmallScene s{Shape{}};
    s.scene.initial_stress.vertical = 50e3;
    s.add(soil, 1600.0);
    Body body(s.scene);
    body.each_point(
        [&](PointColumns& c, std::size_t slot, const PointRecord&) { ASSERT_EQ(c.state[0][slot], 50e3); });
    s.scene.initial_stress.vertical = 70e3;
    EXPECT_EQ(message([&] { Body other(s.scene); }), "material 'soil': too much for this soil");
}

} // namespace
} // namespace gault::core::test
