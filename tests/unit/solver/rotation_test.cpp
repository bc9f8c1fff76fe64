#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, pi = std::numbers::pi;

using Matrix = std::array<std::array<double, 2>, 2>;

Matrix turned(double angle, double stretch_x, double stretch_y) { // R U
    const double c = std::cos(angle), s = std::sin(angle);
    return {{{c * stretch_x, -s * stretch_y}, {s * stretch_x, c * stretch_y}}};
}

// A block with stress and tensor and vector states, driven through F(t), t in [0, 1], in equal steps. In the
// total frame the nodes take the chords between the positions F X, so that a rotation is rigid in every step.
// The updated frame keeps its walls straight: there only strain and stress are taken from the velocities, and
// the grid stays (USF).
class DrivenBlock {
  public:
    DrivenBlock(Frame frame, Basis basis) : soil_(lame, shear), scene_(shape(frame, basis)) {
        soil_.states = {{"fabric", "1", "", GAULT_SYMMETRIC, 0, 0.0, -10.0, 10.0},
                        {"director", "1", "", GAULT_VECTOR, 0, 0.0, -10.0, 10.0},
                        {"amount", "1", "", GAULT_SCALAR, 0, 0.7, -10.0, 10.0}};
        soil_.start = [](gault_points& p, gault_error&) {
            for (int64_t i = 0; i < p.count; ++i) {
                for (int k = 0; k < 6; ++k)
                    p.stress[k][i] = stress0[k];
                for (int k = 0; k < 10; ++k)
                    p.state[k][i] = state0[k];
            }
            return gault_status(GAULT_OK);
        };
        scene_.add(soil_, 1600.0);
        scene_.scene.solver.stress_update = StressUpdate::usf;
        body_ = std::make_unique<Body>(scene_.scene);
    }

    template <class Path>
    void drive(Path f, int steps) {
        const bool total = scene_.scene.frame == Frame::total;
        for (int n = 0; n < steps; ++n) {
            const Matrix from = f(double(n) / steps), to = f(double(n + 1) / steps);
            Matrix h;
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j)
                    h[i][j] = to[i][j] - from[i][j];
            if (!total) { // relative to the present configuration
                const double det = from[0][0] * from[1][1] - from[0][1] * from[1][0];
                h = {{{(h[0][0] * from[1][1] - h[0][1] * from[1][0]) / det,
                       (h[0][1] * from[0][0] - h[0][0] * from[0][1]) / det},
                      {(h[1][0] * from[1][1] - h[1][1] * from[1][0]) / det,
                       (h[1][1] * from[0][0] - h[1][0] * from[0][1]) / det}}};
            }
            body_->motion->deform(body_->field([&](double x, double y) {
                return std::array{h[0][0] * x + h[0][1] * y, h[1][0] * x + h[1][1] * y};
            }),
                                  {1.0, 1.0});
        }
    }
    // The same at every point, or the test fails.
    std::array<double, 16> values() {
        std::array<double, 16> first{};
        bool started = false;
        body_->each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
            std::array<double, 16> here;
            for (int k = 0; k < 6; ++k)
                here[k] = c.stress[k][slot];
            for (int k = 0; k < 10; ++k)
                here[6 + k] = c.state[k][slot];
            if (!started) first = here;
            started = true;
            for (int k = 0; k < 16; ++k)
                ASSERT_NEAR(here[k], first[k], k < 6 ? 1e-5 : 1e-10);
        });
        return first;
    }
    static constexpr double stress0[6] = {-100e3, -250e3, -180e3, 60e3, 20e3, -30e3};
    static constexpr double state0[10] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 1.0, 2.0, 3.0, 0.7};

  private:
    static Shape shape(Frame frame, Basis basis) {
        Shape s;
        s.frame = frame;
        s.basis = basis;
        s.lower = {-0.5, -0.3};
        return s;
    }
    TestMaterial soil_;
    SmallScene scene_;
    std::unique_ptr<Body> body_;
};

class RotatedBlock : public testing::TestWithParam<std::tuple<Frame, Basis>> {
  protected:
    DrivenBlock block{std::get<0>(GetParam()), std::get<1>(GetParam())};
};

TEST_P(RotatedBlock, HasItsTensorsBackAfterAFullTurn) {
    block.drive([](double t) { return turned(2 * pi * t, 1.0, 1.0); }, 90);
    const auto v = block.values();
    for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(v[k], DrivenBlock::stress0[k], 1e-10 * 250e3) << k;
    for (int k = 0; k < 10; ++k)
        EXPECT_NEAR(v[6 + k], DrivenBlock::state0[k], 1e-12) << k;
}

TEST_P(RotatedBlock, HasItsTensorsTurnedAfterAQuarter) {
    block.drive([](double t) { return turned(0.5 * pi * t, 1.0, 1.0); }, 30);
    const auto v = block.values();
    const auto& s = DrivenBlock::stress0;
    const double stress[6] = {s[1], s[0], s[2], -s[3], s[5], -s[4]}; // x goes to y, y to -x
    const auto& f = DrivenBlock::state0;
    const double state[10] = {f[1], f[0], f[2], -f[3], f[5], -f[4], -f[7], f[6], f[8], f[9]};
    for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(v[k], stress[k], 1e-10 * 250e3) << k;
    for (int k = 0; k < 10; ++k)
        EXPECT_NEAR(v[6 + k], state[k], 1e-12) << k;
}

// With a stretch on the way, the stress differs from the unrotated path's by the step error, of second order.
TEST_P(RotatedBlock, ForgetsARotationThatCameWithAStretchToSecondOrder) {
    const auto error = [&](int steps) {
        DrivenBlock rotated(std::get<0>(GetParam()), std::get<1>(GetParam())),
            straight(std::get<0>(GetParam()), std::get<1>(GetParam()));
        rotated.drive([](double t) { return turned(2 * pi * t, 1.0 + 0.2 * t, 1.0 - 0.1 * t); }, steps);
        straight.drive([](double t) { return turned(0.0, 1.0 + 0.2 * t, 1.0 - 0.1 * t); }, steps);
        const auto a = rotated.values(), b = straight.values();
        double largest = 0.0;
        for (int k = 0; k < 6; ++k)
            largest = std::max(largest, std::abs(a[k] - b[k]));
        return largest;
    };
    const double coarse = error(60), fine = error(120);
    const double angle = 2 * pi / 120, stress = 2 * shear * 0.3; // of a step; of the whole stretch
    EXPECT_LT(fine, 0.25 * angle * angle * stress);
    EXPECT_GT(std::log2(coarse / fine), 1.9);
}

INSTANTIATE_TEST_SUITE_P(Frames, RotatedBlock,
                         testing::Combine(testing::Values(Frame::total, Frame::updated),
                                          testing::Values(Basis::linear, Basis::quadratic)),
                         [](const auto& instance) {
                             return std::string(std::get<0>(instance.param) == Frame::total ? "Total"
                                                                                            : "Updated") +
                                    (std::get<1>(instance.param) == Basis::linear ? "Linear" : "Quadratic");
                         });

} // namespace
} // namespace gault::core::test
