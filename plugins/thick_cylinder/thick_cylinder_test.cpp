#include "finite_strain_cylinder.hpp"
#include "plugin_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;
using namespace thick_cylinder;

// Case III: 100 kPa everywhere, then 400 kPa in the cavity.
constexpr Elastic stiffness{70e6, 0.3};
constexpr MohrCoulomb soil{1e3, 40.0 * degree, -2.0 * degree};
constexpr double a0 = 2.0, b0 = 14.0, p0 = 100e3, p = 400e3;

// Soil F of the literature on Fahey's test (1986): 90 kPa, radii 20 and 200 mm.
constexpr Elastic sand_stiffness{100e6, 0.25};
constexpr MohrCoulomb sand{1e3, 48.0 * degree, 16.5 * degree};

TEST(Lame, MeetsBothPressuresAndHookesLaw) {
    const Lame cylinder(2.0, 20.0, 20e6, 10e6);
    EXPECT_NEAR(cylinder.at(2.0).radial, 20e6, 1e-6);
    EXPECT_NEAR(cylinder.at(20.0).radial, 10e6, 1e-6);
    // Hoop strain is displacement over radius: 2G u/r = -[(1-nu) d sigma_theta - nu d sigma_r], compression
    // positive.
    const Elastic rock{70e9, 0.3};
    for (const double r : {2.0, 7.0, 20.0}) {
        const double hoop = cylinder.at(r).hoop - 5e6, radial = cylinder.at(r).radial - 5e6;
        EXPECT_NEAR(cylinder.displacement(r, rock, 5e6),
                    -r * ((1.0 - 0.3) * hoop - 0.3 * radial) / (2.0 * rock.shear()), 1e-15);
    }
}

struct Tabulated { // m, kPa, kPa: seven digits
    double radius, radial, hoop;
};

TEST(MohrCoulombCylinder, HasTheStressesTabulatedForCaseThree) {
    const MohrCoulombCylinder cylinder{soil, a0, b0, p0};
    const double c = cylinder.plastic_radius(p);
    for (const Tabulated& t : {Tabulated{2.0, 400.0, 86.04452}, Tabulated{2.1, 384.9708, 82.77653},
                               Tabulated{5.0, 194.6662, 41.39615}, Tabulated{7.7, 138.508, 29.18495},
                               Tabulated{7.8, 137.1058, 29.48905}, Tabulated{14.0, 100.0, 66.59487}}) {
        const Stresses s = cylinder.at(t.radius, p, c);
        EXPECT_NEAR(s.radial, 1e3 * t.radial, 0.06) << t.radius;
        EXPECT_NEAR(s.hoop, 1e3 * t.hoop, 0.06) << t.radius;
    }
    EXPECT_NEAR(c, 7.764, 5e-4);
}

TEST(MohrCoulombCylinder, IsInBalanceAndContinuousAcrossThePlasticRadius) {
    const MohrCoulombCylinder cylinder{soil, a0, b0, p0};
    const double c = cylinder.plastic_radius(p), h = 1e-4;
    for (const double r : {2.5, 5.0, 9.0, 13.0}) {
        const double slope = (cylinder.at(r + h, p, c).radial - cylinder.at(r - h, p, c).radial) / (2.0 * h);
        const Stresses s = cylinder.at(r, p, c);
        EXPECT_NEAR(slope, -(s.radial - s.hoop) / r, 1e-3) << r;
    }
    EXPECT_NEAR(cylinder.at(c - 1e-9, p, c).radial, cylinder.at(c + 1e-9, p, c).radial, 1e-3);
    EXPECT_NEAR(cylinder.at(c - 1e-9, p, c).hoop, cylinder.at(c + 1e-9, p, c).hoop, 1e-3);
}

TEST(MohrCoulombCylinder, IsLameBelowFirstYield) {
    const MohrCoulombCylinder cylinder{soil, a0, b0, p0};
    const double pressure = cylinder.first_yield();
    const Stresses s = cylinder.at(a0, pressure, cylinder.plastic_radius(pressure));
    EXPECT_NEAR(s.radial, soil.alpha() * s.hoop + soil.strength(), 1e-6);
    EXPECT_NEAR(cylinder.plastic_radius(pressure * (1.0 + 1e-9)), a0, 1e-6);
}

TEST(FiniteStrainCylinder, HasTheDeformedRadiiOfCaseThree) {
    const auto radii = FiniteStrainCylinder(stiffness, soil, a0, b0, p0).at(p);
    ASSERT_TRUE(radii);
    EXPECT_NEAR(radii->inner, 2.042547, 1e-6);
    EXPECT_NEAR(radii->outer, 14.006459, 1e-6);
    const MohrCoulombCylinder deformed{soil, radii->inner, radii->outer, p0};
    EXPECT_NEAR(deformed.plastic_radius(p), 8.056, 5e-4);
}

TEST(FiniteStrainCylinder, FollowsTheRisingPressureCurveOfFaheysSand) {
    const FiniteStrainCylinder cylinder(sand_stiffness, sand, 0.02, 0.2, 90e3);
    // Cavity strain in per cent, pressure in kPa to five digits: 0.005 kPa over a slope of 37 kPa a per cent
    // at 3 %.
    const std::array<double, 2> curve[] = {{0.2, 223.78}, {0.5, 327.47}, {1.0, 435.47},
                                           {2.0, 561.93}, {2.5, 598.62}, {3.0, 620.80}};
    for (const auto& [strain, pressure] : curve) {
        const auto radii = cylinder.at(1e3 * pressure);
        ASSERT_TRUE(radii);
        EXPECT_NEAR(radii->inner / 0.02 - 1.0, strain / 100.0, 2e-6) << pressure;
    }
    EXPECT_FALSE(cylinder.at(640e3)); // the peak is 628.15 kPa
}

TEST(FiniteStrainCylinder, ExpandsElasticallyByCauchyStressFromLogarithmicStrain) {
    // Cylinder b0/a0 = 10, p/E at a/a0 = 1.01 and 1.1, in a soil too strong to yield.
    const MohrCoulomb strong{5e5, 30.0 * degree, 0.0};
    const std::array<double, 3> table[] = {
        {0.0, 0.00970258, 1.01}, {0.0, 0.0889068, 1.1}, {0.3, 0.00750852, 1.01}, {0.3, 0.0688163, 1.1}};
    for (const auto& [nu, pressure, ratio] : table) {
        const auto radii = FiniteStrainCylinder({1e6, nu}, strong, 1.0, 10.0, 0.0).at(1e6 * pressure);
        ASSERT_TRUE(radii);
        EXPECT_NEAR(radii->inner, ratio, 2e-6 * ratio) << nu;
    }
}

// Case III as a sample: points that carry the stresses of a cylinder, on current radii that grew as the
// cavity did.
class Rings {
  public:
    Rings(const Component& observer, const MohrCoulombCylinder& cylinder, double radius)
        : observer_(observer), results_(observer.api<gault_observer_api>().result_count) {
        const double c = cylinder.plastic_radius(p);
        for (int i = 0; i < 200; ++i) {
            const double r = cylinder.inner + (cylinder.outer - cylinder.inner) * (i + 0.5) / 200.0;
            const Stresses s = cylinder.at(r, p, c);
            position_.push_back(r);
            reference_.push_back(std::sqrt(r * r - cylinder.inner * cylinder.inner + a0 * a0));
            radial_.push_back(-s.radial);
            hoop_.push_back(-s.hoop);
            volume_.push_back(2.0 * M_PI * r);
            strain_.push_back(r < c ? 1e-3 : 0.0);
        }
        sample_.size = sizeof sample_;
        sample_.count = 200;
        sample_.position[0] = position_.data();
        sample_.reference_position[0] = reference_.data();
        sample_.stress[0] = radial_.data();
        sample_.stress[2] = hoop_.data();
        sample_.volume = volume_.data();
        fields_[0] = strain_.data();
        sample_.field = fields_;
        measure_[0] = radius;
        sample_.measure = measure_;
        sample_.result = results_.data();
    }
    double result(const std::string& name) {
        const auto& api = observer_.api<gault_observer_api>();
        gault_error error{-1, 0, -1, ""};
        EXPECT_EQ(api.evaluate(observer_.self(), &sample_, &error), GAULT_OK) << error.text;
        for (uint32_t i = 0; i < api.result_count; ++i)
            if (name == api.results[i].name) return results_[i];
        throw std::runtime_error("no result " + name);
    }
    void scale_hoop(double factor) {
        for (double& s : hoop_)
            s *= factor;
    }

  private:
    const Component& observer_;
    std::vector<double> results_, position_, reference_, radial_, hoop_, volume_, strain_;
    double measure_[1];
    const double* fields_[1];
    gault_sample sample_{};
};

const Settings case_three{{"young_modulus", 70e6},
                          {"poisson_ratio", 0.3},
                          {"cohesion", 1e3},
                          {"friction_angle", 40.0 * degree},
                          {"dilation_angle", -2.0 * degree},
                          {"inner_radius", a0},
                          {"outer_radius", b0},
                          {"initial_pressure", p0},
                          {"inner_pressure", p},
                          {"outer_pressure", p0}};
Component observer(const Settings& settings) {
    return {"thick_cylinder", GAULT_OBSERVER, "thick_cylinder", settings};
}

TEST(ThickCylinder, FindsNoErrorInTheClosedFormOfTheDeformedCylinder) {
    const Component c = observer(case_three);
    const auto radii = FiniteStrainCylinder(stiffness, soil, a0, b0, p0).at(p);
    Rings rings(c, {soil, radii->inner, radii->outer, p0}, radii->inner);
    EXPECT_LT(rings.result("sigma_r_l2"), 1e-12);
    EXPECT_LT(rings.result("sigma_theta_l2"), 1e-12);
    EXPECT_LT(rings.result("inner_displacement_error"), 1e-12);
    // Against the initial cylinder at current radii a finite-element solution differs by 1.40 and 4.62 %.
    EXPECT_NEAR(rings.result("sigma_r_l2_current"), 0.0140, 2e-4);
    EXPECT_NEAR(rings.result("sigma_theta_l2_current"), 0.0462, 3e-4);
    EXPECT_NEAR(rings.result("plastic_radius"), rings.result("plastic_radius_exact"), 12.0 / 200.0);
    EXPECT_NEAR(rings.result("plastic_radius_initial"), 7.764, 5e-4);
}

TEST(ThickCylinder, MeasuresRelativeErrors) {
    const Component c = observer(case_three);
    const auto radii = FiniteStrainCylinder(stiffness, soil, a0, b0, p0).at(p);
    Rings rings(c, {soil, radii->inner, radii->outer, p0}, a0 + 1.02 * (radii->inner - a0));
    rings.scale_hoop(0.95);
    EXPECT_NEAR(rings.result("sigma_theta_l2"), 0.05, 1e-12);
    EXPECT_LT(rings.result("sigma_r_l2"), 1e-12);
    EXPECT_NEAR(rings.result("inner_displacement_error"), 0.02, 1e-9);
}

TEST(ThickCylinder, ComparesWithLameWhereNoStrengthIsGiven) {
    const Component c = observer({{"young_modulus", 70e9},
                                  {"poisson_ratio", 0.3},
                                  {"inner_radius", 2.0},
                                  {"outer_radius", 20.0},
                                  {"inner_pressure", 20e6},
                                  {"outer_pressure", 10e6}});
    const Lame lame(2.0, 20.0, 20e6, 10e6);
    const double position[] = {3.0}, volume[] = {1.0};
    const double radial[] = {-lame.at(3.0).radial}, hoop[] = {-lame.at(3.0).hoop}, measure[] = {2.0};
    const double* const no_field[] = {nullptr};
    double results[13];
    gault_sample sample{};
    sample.field = no_field;
    sample.size = sizeof sample;
    sample.count = 1;
    sample.position[0] = sample.reference_position[0] = position;
    sample.stress[0] = radial;
    sample.stress[2] = hoop;
    sample.volume = volume;
    sample.measure = measure;
    sample.result = results;
    gault_error error{-1, 0, -1, ""};
    const auto& api = c.api<gault_observer_api>();
    ASSERT_EQ(api.result_count, 13u);
    ASSERT_EQ(api.evaluate(c.self(), &sample, &error), GAULT_OK);
    EXPECT_LT(results[0], 1e-15);
    EXPECT_LT(results[1], 1e-15);
    EXPECT_TRUE(std::isnan(results[9])); // no plastic radius
}

TEST(ThickCylinder, RefusesWhatItsClosedFormsDoNotCover) {
    const auto refused = [](const std::string& name, double value) {
        Settings settings = case_three;
        settings[name] = value;
        try {
            observer(settings);
        } catch (const Invalid& e) {
            return e.parameter;
        }
        return std::string("accepted");
    };
    EXPECT_EQ(refused("outer_radius", 1.0), "outer_radius");
    EXPECT_EQ(refused("outer_pressure", 120e3), "outer_pressure");
    EXPECT_EQ(refused("inner_pressure", 90e3), "inner_pressure");
    EXPECT_EQ(refused("inner_pressure", 470e3), "inner_pressure"); // collapse at 462.8 kPa
    EXPECT_EQ(refused("poisson_ratio", 0.2), "accepted");          // axial 193 kPa, hoop 86.6 kPa
    EXPECT_EQ(refused("poisson_ratio", -0.1), "poisson_ratio");    // axial 71.3 kPa
    Settings incomplete = case_three;
    incomplete.erase("friction_angle");
    EXPECT_THROW(observer(incomplete), Invalid);
}

} // namespace
