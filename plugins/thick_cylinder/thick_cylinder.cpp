#include "finite_strain_cylinder.hpp"

#include <gault/observer.hpp>

#include <algorithm>

// Compares an expanded or compressed cylinder with closed forms: Lame where no strength is given,
// Mohr-Coulomb where it is. See README.md for what is compared with what.
namespace thick_cylinder {

struct ThickCylinder {
    static constexpr const char* name = "thick_cylinder";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "Errors of stress, displacement and plastic radius of a thick cylinder.";
    static constexpr const char* reference =
        "Timoshenko and Goodier (1970); Yu (1992), Computers and Geotechnics 14, 21-41";

    double young_modulus, poisson_ratio;
    std::optional<double> cohesion, friction_angle, dilation_angle;
    double inner_radius, outer_radius;
    std::optional<double> initial_pressure;
    double inner_pressure, outer_pressure;

    static constexpr std::array parameters{
        gault::parameter<&ThickCylinder::young_modulus>("young_modulus", "E", "Pa", "Young's modulus.")
            .above(0),
        gault::parameter<&ThickCylinder::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio.")
            .above(-1)
            .below(0.5),
        gault::parameter<&ThickCylinder::cohesion>("cohesion", "c", "Pa", "Cohesion.").at_least(0),
        gault::parameter<&ThickCylinder::friction_angle>("friction_angle", "phi", "rad", "Friction angle.")
            .above(0)
            .below(0.5 * gault::pi),
        gault::parameter<&ThickCylinder::dilation_angle>("dilation_angle", "psi", "rad", "Dilation angle.")
            .above(-0.5 * gault::pi)
            .below(0.5 * gault::pi),
        gault::parameter<&ThickCylinder::inner_radius>("inner_radius", "a0", "m", "Initial inner radius.")
            .above(0),
        gault::parameter<&ThickCylinder::outer_radius>("outer_radius", "b0", "m", "Initial outer radius.")
            .above(0),
        gault::parameter<&ThickCylinder::initial_pressure>(
            "initial_pressure", "p0", "Pa",
            "Isotropic initial stress, compression positive; outer_pressure if absent."),
        gault::parameter<&ThickCylinder::inner_pressure>("inner_pressure", "p", "Pa",
                                                         "Pressure in the cavity."),
        gault::parameter<&ThickCylinder::outer_pressure>("outer_pressure", "", "Pa",
                                                         "Pressure on the outside.")};

    enum { radius };
    static constexpr std::array measures{gault::signal("radius", "m", "Mean current radius of the cavity.")};
    enum { plastic_strain };
    static constexpr std::array fields{"plastic_strain"};
    enum {
        sigma_r_l2,
        sigma_theta_l2,
        sigma_r_l2_initial,
        sigma_theta_l2_initial,
        sigma_r_l2_current,
        sigma_theta_l2_current,
        inner_radius_exact,
        inner_radius_found,
        inner_displacement_error,
        plastic_radius_exact,
        plastic_radius_found,
        plastic_radius_error,
        plastic_radius_initial
    };
    static constexpr std::array results{
        gault::signal("sigma_r_l2", "1", "Error of radial stress: deformed cylinder; elastic: as _initial."),
        gault::signal("sigma_theta_l2", "1",
                      "Error of hoop stress: deformed cylinder; elastic: as _initial."),
        gault::signal("sigma_r_l2_initial", "1",
                      "Error of radial stress: initial cylinder, reference positions."),
        gault::signal("sigma_theta_l2_initial", "1",
                      "Error of hoop stress: initial cylinder, reference positions."),
        gault::signal("sigma_r_l2_current", "1",
                      "Error of radial stress: initial cylinder, current positions."),
        gault::signal("sigma_theta_l2_current", "1",
                      "Error of hoop stress: initial cylinder, current positions."),
        gault::signal("inner_radius_exact", "m", "Current inner radius of the closed form."),
        gault::signal("inner_radius", "m", "Current inner radius, measured."),
        gault::signal("inner_displacement_error", "1",
                      "Relative error of the displacement of the inner radius."),
        gault::signal("plastic_radius_exact", "m",
                      "Plastic radius of the closed form on the deformed cylinder."),
        gault::signal("plastic_radius", "m", "Current radius of the outermost plastic point."),
        gault::signal("plastic_radius_error", "1", "Relative error of the plastic radius."),
        gault::signal("plastic_radius_initial", "m",
                      "Plastic radius of the closed form on the initial cylinder.")};

    bool plastic;
    double start; // p0, Pa
    DeformedRadii deformed;

    void prepare() {
        if (outer_radius <= inner_radius)
            throw gault::Invalid("outer_radius", "is not larger than inner_radius");
        start = initial_pressure.value_or(outer_pressure);
        plastic = cohesion || friction_angle || dilation_angle;
        if (plastic) {
            prepare_plastic();
        } else {
            const double u = elastic_cylinder().displacement(inner_radius, elastic(), start);
            const double rim = elastic_cylinder().displacement(outer_radius, elastic(), start);
            deformed = {inner_radius + u, outer_radius + rim};
        }
    }
    void prepare_plastic() {
        if (!cohesion) throw gault::Invalid("cohesion", "is required with friction_angle or dilation_angle");
        if (!friction_angle)
            throw gault::Invalid("friction_angle", "is required with cohesion or dilation_angle");
        if (!dilation_angle)
            throw gault::Invalid("dilation_angle", "is required with cohesion and friction_angle");
        if (outer_pressure != start)
            throw gault::Invalid("outer_pressure",
                                 "the plastic closed form needs it equal to initial_pressure");
        if (inner_pressure < start)
            throw gault::Invalid("inner_pressure",
                                 "the plastic closed form is for expansion, at least initial_pressure");
        const auto radii =
            FiniteStrainCylinder(elastic(), soil(), inner_radius, outer_radius, start).at(inner_pressure);
        if (!radii || inner_pressure >= cylinder({inner_radius, outer_radius}).collapse())
            throw gault::Invalid("inner_pressure",
                                 "the cylinder is plastic to its outside before this pressure");
        deformed = *radii;
        // The closed form flows in the plane; the axial stress, elastic, must stay between the others.
        const double hoop = (inner_pressure - soil().strength()) / soil().alpha();
        const double axial = poisson_ratio * (inner_pressure + hoop) + (1.0 - 2.0 * poisson_ratio) * start;
        if (inner_pressure > cylinder({inner_radius, outer_radius}).first_yield() && axial < hoop)
            throw gault::Invalid("poisson_ratio",
                                 "the closed form needs an axial stress between the others; at the wall it "
                                 "would be below the hoop stress");
    }

    Elastic elastic() const { return {young_modulus, poisson_ratio}; }
    MohrCoulomb soil() const { return {*cohesion, *friction_angle, *dilation_angle}; }
    Lame elastic_cylinder() const { return {inner_radius, outer_radius, inner_pressure, outer_pressure}; }
    MohrCoulombCylinder cylinder(const DeformedRadii& r) const { return {soil(), r.inner, r.outer, start}; }

    // Relative L2 errors over the raw points, weighted by their current volume.
    template <class Exact, class Radius>
    static Stresses errors(const gault::Sample& sample, Exact exact, Radius radius_of) {
        Stresses difference{}, size{};
        for (int64_t i = 0; i < sample.count(); ++i) {
            const Stresses expected = exact(radius_of(i));
            const double radial = -sample.stress(0, i) - expected.radial,
                         hoop = -sample.stress(2, i) - expected.hoop;
            difference.radial += sample.volume(i) * radial * radial;
            difference.hoop += sample.volume(i) * hoop * hoop;
            size.radial += sample.volume(i) * expected.radial * expected.radial;
            size.hoop += sample.volume(i) * expected.hoop * expected.hoop;
        }
        return {std::sqrt(difference.radial / size.radial), std::sqrt(difference.hoop / size.hoop)};
    }

    void evaluate(gault::Sample& sample) const {
        const auto current = [&](int64_t i) { return sample.position(0, i); };
        const auto reference_radius = [&](int64_t i) { return sample.reference_position(0, i); };
        const auto write = [&](int index, const Stresses& error) {
            sample.result(index) = error.radial;
            sample.result(index + 1) = error.hoop;
        };
        if (plastic) {
            const MohrCoulombCylinder now = cylinder(deformed), then = cylinder({inner_radius, outer_radius});
            const double c_now = now.plastic_radius(inner_pressure),
                         c_then = then.plastic_radius(inner_pressure);
            const auto on_deformed = [&](double r) { return now.at(r, inner_pressure, c_now); };
            const auto on_initial = [&](double r) { return then.at(r, inner_pressure, c_then); };
            write(sigma_r_l2, errors(sample, on_deformed, current));
            write(sigma_r_l2_initial, errors(sample, on_initial, reference_radius));
            write(sigma_r_l2_current, errors(sample, on_initial, current));
            if (c_now > deformed.inner) write_plastic_radius(sample, c_now, c_then);
        } else {
            const auto exact = [lame = elastic_cylinder()](double r) { return lame.at(r); };
            const Stresses initial = errors(sample, exact, reference_radius);
            write(sigma_r_l2, initial);
            write(sigma_r_l2_initial, initial);
            write(sigma_r_l2_current, errors(sample, exact, current));
        }
        sample.result(inner_radius_exact) = deformed.inner;
        sample.result(inner_radius_found) = sample.measure(radius);
        if (deformed.inner != inner_radius)
            sample.result(inner_displacement_error) =
                std::abs((sample.measure(radius) - deformed.inner) / (deformed.inner - inner_radius));
    }

    void write_plastic_radius(gault::Sample& sample, double exact, double exact_initial) const {
        sample.result(plastic_radius_exact) = exact;
        sample.result(plastic_radius_initial) = exact_initial;
        if (!sample.has_field(plastic_strain)) return;
        double outermost = 0.0;
        for (int64_t i = 0; i < sample.count(); ++i)
            if (sample.field(plastic_strain, i) > 1e-9)
                outermost = std::max(outermost, sample.position(0, i));
        sample.result(plastic_radius_found) = outermost;
        sample.result(plastic_radius_error) = std::abs(outermost / exact - 1.0);
    }
};

} // namespace thick_cylinder

GAULT_MODULE("thick_cylinder", "1.0.0", "The Gault authors", "MIT",
             gault::Observer<thick_cylinder::ThickCylinder>)
