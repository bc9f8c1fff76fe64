// What the sand does: published numbers, critical states, dilatancy, and the equations written a second time.
#include "sand_test.hpp"

namespace {
using namespace norsand_test;

struct Row { // nominal axial strain; kPa
    double strain, p, q, e, image_ratio;
};

// NorTxl2_r4 of Jefferies and Been for Nerlerk 270/1 sand, psi_0 = 0.108 at 500 kPa, OCR 1: what it computed for a drained and
// an undrained test (with additional softening), as published with the UMAT of Zambrano-Cruzatty (NorSand-VT). H, lambda_10,
// the step and the water follow from the numbers, of which there are some thousands.
constexpr Row drained_sheet[] = {{0.01008470498, 593.9434122, 281.8302367, 0.83911263, 0.526907035},
                                 {0.03006073933, 690.6730874, 572.0192621, 0.81882844, 0.682922114},
                                 {0.07750705508, 793.7564745, 881.2694234, 0.788727032, 0.825074732},
                                 {0.2170712864, 913.2910717, 1239.873215, 0.747313955, 0.951141488}};
constexpr Row undrained_sheet[] = {{0.00445759055, 292.2292516, 192.3586264, 0.852918808, 0.606247563},
                                   {0.00859690332, 167.0963972, 150.5786368, 0.852686961, 0.724285081},
                                   {0.02998203340, 4.389489786, 6.107532627, 0.852385541, 0.968032185}};

Soil nerlerk(bool drained) {
    Soil s;
    s.gamma = 0.875, s.lambda = 0.048 / 2.3, s.M = 1.45, s.N = 0.43, s.chi = 3.4, s.slope = 0.0;
    s.H = drained ? 50.0 : 40.0, s.softening = drained ? 0.0 : 1.0;
    s.shear = 71.5e6, s.reference = 500e3, s.power = 0.4, s.nu = 0.15, s.psi = 0.108;
    return s;
}

// The algorithm of the spreadsheet: Euler steps of plastic shear strain, 5.94763e-5 each. Its water has 1 GPa.
class Spreadsheet {
  public:
    Spreadsheet(bool drained, double step) : soil_(nerlerk(drained)), drained_(drained), step_(step) {}

    Row at(double strain) { // between two steps, linearly
        Row before = now();
        while (now().strain < strain) {
            before = now();
            advance();
        }
        const Row after = now();
        const double share =
            after.strain == before.strain ? 1.0 : (strain - before.strain) / (after.strain - before.strain);
        const auto mix = [share](double a, double b) { return a + share * (b - a); };
        return {strain, mix(before.p, after.p), mix(before.q, after.q), mix(before.e, after.e),
                mix(before.image_ratio, after.image_ratio)};
    }

  private:
    Row now() const { return {1.0 - height_, p_ / 1e3, q_ / 1e3, e_, ratio_}; }
    void advance() {
        const double psi_i = soil_.state(e_, ratio_ * p_), dilatancy = soil_.chi_i() * psi_i, eta = q_ / p_;
        const double G = soil_.G(p_), K = G / soil_.g(), m = soil_.M - soil_.N * std::abs(dilatancy),
                     D = m - eta;
        double growth = soil_.H / (ratio_ * ratio_) * (std::exp(-dilatancy / m) - ratio_);
        if (!drained_)
            growth -= (1.0 - soil_.chi * soil_.lambda / soil_.M) * D * eta / (m - dilatancy) * K / p_;
        growth *= step_;
        double p, q;
        if (drained_) {
            const double change = eta * (1.0 - (m_ > 0.0 ? m_ : m) / m) + m * growth;
            const double next = eta + change / (1.0 + m / (3.0 - eta));
            p = p_ + p_ * (next - eta) / (3.0 - next);
            q = q_ + p_ * (next - eta) + next * (p - p_);
            ratio_ = std::exp(q / p / m - 1.0);
        } else {
            p = p_ - D * step_ * K * water / (K + water);
            ratio_ *= (1.0 + growth) * p_ / p;
            q = p * m * (1.0 + std::log(ratio_));
        }
        const double volume = D * step_ + (p - p_) / K;
        height_ *= 1.0 - (step_ + (q - q_) / (3.0 * G) + volume / 3.0);
        e_ -= (1.0 + e_) * volume;
        p_ = p, q_ = q, m_ = m;
    }

    static constexpr double water = 1e9;
    Soil soil_;
    bool drained_;
    double step_, p_ = 500e3, q_ = 0.0, e_ = 0.853303831, ratio_ = std::exp(-1.0), height_ = 1.0, m_ = 0.0;
};

TEST(NorSand, FollowsTheSpreadsheetOfJefferiesAndBeen) {
    constexpr double step = 5.94763e-5;
    for (const bool drained : {true, false}) {
        const Component c = nerlerk(drained).component();
        Laboratory lab(c, isotropic(500e3));
        Spreadsheet sheet(drained, step), fine(drained, step / 32), finer(drained, step / 64);
        double reached = 0.0;
        for (const Row& row :
             drained ? std::vector<Row>(std::begin(drained_sheet), std::end(drained_sheet))
                     : std::vector<Row>(std::begin(undrained_sheet), std::end(undrained_sheet))) {
            const Row again = sheet.at(row.strain), a = fine.at(row.strain), b = finer.at(row.strain);
            EXPECT_NEAR(again.p, row.p, 1e-6 * row.p); // six digits of the step, eight of the strain
            EXPECT_NEAR(again.q, row.q, 1e-6 * row.q);
            EXPECT_NEAR(again.e, row.e, 1e-7);
            EXPECT_NEAR(again.image_ratio, row.image_ratio, 1e-6);

            const double strain = -std::log1p(-row.strain);
            const int steps = 400;
            for (int i = 0; i < steps; ++i) {
                const double axial = (strain - reached) / steps;
                const double volume = (500e3 - lab.p()) / 1e9 + lab.volumetric_strain(); // lags by a step
                if (drained)
                    lab.triaxial_drained(-axial, -500e3);
                else
                    lab.strain_step({-axial, 0.5 * (axial - volume), 0.5 * (axial - volume), 0.0, 0.0, 0.0});
            }
            reached = strain;
            // Its Euler steps are off by up to 1.1e-3 (drained) and 6e-3 of q: they are extrapolated to none.
            // The lag of the volume undrained is worth 10 Pa at the end.
            EXPECT_NEAR(lab.p() / 1e3, 2.0 * b.p - a.p, 1e-4 * row.p + 0.015);
            EXPECT_NEAR(lab.q() / 1e3, 2.0 * b.q - a.q, 1e-4 * row.q + 0.02);
            EXPECT_NEAR(lab.state(void_ratio), 2.0 * b.e - a.e, 1e-5);
            EXPECT_NEAR(lab.state(image_pressure) / lab.p(), 2.0 * b.image_ratio - a.image_ratio, 1e-4);
        }
    }
}

TEST(NorSand, EndsAtTheCriticalStateDrainedFromLooseAndDense) {
    for (const double psi : {-0.2, 0.07}) {
        Soil soil;
        soil.psi = psi, soil.chi = 8.0; // the end is near
        const Component c = soil.component(variants().back());
        Laboratory lab(c, isotropic(100e3));
        for (int i = 0; i < 160; ++i)
            lab.triaxial_drained(-5e-3, -100e3);
        const double p = 3.0 / (3.0 - soil.M) * 100e3; // q = M p = 3 (p - 100 kPa)
        // psi falls as exp(-(1 + e) chi eps_q), to some 1e-5 of the start.
        EXPECT_NEAR(lab.p(), p, 1e-4 * p);
        EXPECT_NEAR(lab.q(), soil.M * p, 1e-4 * p);
        EXPECT_NEAR(lab.state(void_ratio), soil.gamma - soil.lambda * std::log(p / 1e3), 1e-4);
    }
}

TEST(NorSand, EndsAtTheCriticalStateInExtension) {
    Soil soil;
    soil.psi = -0.03, soil.chi = 8.0;
    const Component c = soil.component(variants().back());
    Laboratory lab(c, isotropic(100e3));
    for (int i = 0; i < 270; ++i)
        lab.triaxial_drained(3e-3, -100e3);
    const double M = 3.0 * soil.M / (3.0 + soil.M), p = 100e3 / (1.0 + M / 3.0); // lateral: p + q/3
    EXPECT_NEAR(lab.p(), p, 1e-4 * p); // the rounded edge at compression shifts M here by 3e-5
    EXPECT_NEAR(lab.q(), M * p, 1e-4 * p);
}

// With the additional softening loose sand comes down to p'_f within some 10 % strain; without it p_i keeps it up for long.
TEST(NorSand, LiquefiesUndrainedToTheCriticalStateOfItsVoidRatio) {
    double end[2];
    for (const int softening : {0, 1}) {
        Soil soil;
        soil.psi = 0.03, soil.softening = softening;
        const Component c = soil.component();
        Laboratory lab(c, isotropic(300e3));
        const double e = lab.state(void_ratio), p = 1e3 * std::exp((soil.gamma - e) / soil.lambda);
        double peak = 0.0;
        for (int i = 0; i < 1500; ++i) {
            lab.triaxial_undrained(-2e-4);
            peak = std::max(peak, lab.q());
        }
        end[softening] = lab.p() / p;
        EXPECT_NEAR(lab.state(void_ratio), e, 1e-12);
        EXPECT_GT(peak, 2.0 * lab.q());
    }
    EXPECT_NEAR(end[1], 1.0, 0.01); // it passes p'_f by 1 % and returns as slowly as the other comes down
    EXPECT_GT(end[0], 1.2);
}

// At peak strength D_min = chi_i psi_i = chi_tc psi. M_i grows while the sand loosens, so p_i is a little beyond its limit at the
// peak, by some 1/H: here H is large.
TEST(NorSand, DilatesAtPeakAsItsStateParameterSays) {
    for (const double psi : {-0.1, -0.2}) {
        Soil soil;
        soil.psi = psi, soil.H = 1000.0, soil.slope = 0.0;
        const Component c = soil.component();
        Laboratory lab(c, isotropic(100e3));
        double strain = 0.0, volume = 0.0, q = 0.0;
        do {
            strain = lab.strain()[0], volume = lab.volumetric_strain(), q = lab.q();
            lab.triaxial_drained(-2e-4, -100e3);
        } while (lab.q() > q);
        const double contraction = volume - lab.volumetric_strain(), axial = strain - lab.strain()[0];
        const double D = contraction / (axial - contraction / 3.0);
        const double image = soil.state(lab.state(void_ratio), lab.state(image_pressure));
        EXPECT_NEAR(D, soil.chi_i() * image, 0.01 * std::abs(D));
        EXPECT_NEAR(D, soil.chi * lab.state(state_parameter), 0.02 * std::abs(D));
    }
}

// Two legs of all components, in steps of 2 %, 0.2 % and 0.02 % strain; the plain steps, of first order, extrapolated.
TEST(NorSand, AgreesWithItsEquationsWrittenASecondTime) {
    constexpr Tensor legs[] = {{-0.012, 0.004, 0.005, 0.003, 0.0, 0.0},
                               {0.003, -0.006, 0.004, 0.004, 0.005, -0.002}};
    for (const double psi : {-0.2, -0.05, 0.06})
        for (const double softening : {0.0, 1.0}) {
            if (psi < 0.0 && softening > 0.0) continue; // is of loose sand only
            Soil soil;
            soil.psi = psi, soil.softening = softening;
            Plain plain(soil, isotropic(100e3)), coarse(soil, isotropic(100e3));
            for (const Tensor& leg : legs) {
                plain.strain(leg, 40000);
                coarse.strain(leg, 20000);
            }
            for (const int steps : {1, 10, 100}) {
                const Component c = soil.component();
                Laboratory lab(c, isotropic(100e3));
                for (const Tensor& leg : legs)
                    for (int i = 0; i < steps; ++i) {
                        Tensor part = leg;
                        for (double& x : part)
                            x /= steps;
                        lab.strain_step(part);
                    }
                double worst = 0.0;
                for (std::size_t i = 0; i < 6; ++i)
                    worst = std::max(
                        worst, std::abs(lab.stress()[i] - 2.0 * plain.stress()[i] + coarse.stress()[i]));
                EXPECT_LE(worst, 2e-3 * std::max(100e3, lab.p())) << psi << ' ' << steps;
            }
        }
}

TEST(NorSand, ConvergesWithTheStepAtSecondOrder) {
    const Component c = Soil().component();
    const auto end = [&](int steps) {
        Laboratory lab(c, isotropic(100e3));
        for (int i = 0; i < steps; ++i)
            lab.strain_step({-2e-3 / steps, 0.5e-3 / steps, 0.8e-3 / steps, 0.4e-3 / steps, 0.0, 0.0});
        return lab.stress();
    };
    const Tensor exact = end(4096);
    double error[2];
    for (const int k : {0, 1}) {
        error[k] = 0.0;
        const Tensor s = end(k ? 256 : 64);
        for (std::size_t i = 0; i < 6; ++i)
            error[k] = std::max(error[k], std::abs(s[i] - exact[i]) / mean_pressure(exact));
    }
    const double order = std::log(error[0] / error[1]) / std::log(4.0);
    EXPECT_GT(order, 1.8);
    EXPECT_LT(error[0], 1e-3);
}

} // namespace
