// Modified Cam clay: see README.md for equations and signs.
#include "tangent.hpp"

#include <gault/material.hpp>

namespace modified_cam_clay {
inline namespace GAULT_ISA {

struct Model {
    static constexpr const char* name = "modified_cam_clay";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "Modified Cam clay in effective stress: an ellipse that hardens with "
                                       "plastic volume, and a critical state.";
    static constexpr const char* reference =
        "Roscoe, K. H. and Burland, J. B. (1968), in Engineering Plasticity, Cambridge, 535-609";

    double critical_state_ratio, compression_index, swelling_index;
    std::optional<double> poisson_ratio, shear_modulus, critical_state_volume, initial_void_ratio,
        overconsolidation_ratio, preconsolidation_pressure;
    Clay clay;

    static constexpr std::array parameters{
        gault::parameter<&Model::critical_state_ratio>("critical_state_ratio", "M", "1",
                                                       "q/p' at the critical state, in all directions.")
            .above(0)
            .at_most(5),
        gault::parameter<&Model::compression_index>(
            "compression_index", "lambda", "1", "Slope of normal compression, specific volume over ln p'.")
            .above(0)
            .at_most(10),
        gault::parameter<&Model::swelling_index>("swelling_index", "kappa", "1",
                                                 "Slope of unloading, specific volume over ln p'.")
            .at_least(1e-4),
        gault::parameter<&Model::poisson_ratio>("poisson_ratio", "nu", "1",
                                                "Ratio: G is proportional to p'; give this or shear_modulus.")
            .above(-1)
            .below(0.5)
            .optional(),
        gault::parameter<&Model::shear_modulus>("shear_modulus", "G", "Pa",
                                                "Constant shear modulus; give this or poisson_ratio.")
            .above(0)
            .optional(),
        gault::parameter<&Model::critical_state_volume>(
            "critical_state_volume", "Gamma", "1",
            "Specific volume at the critical state at p' = 1 kPa; give this or initial_void_ratio.")
            .above(1)
            .optional(),
        gault::parameter<&Model::initial_void_ratio>(
            "initial_void_ratio", "e_0", "1", "Void ratio everywhere; give this or critical_state_volume.")
            .above(0)
            .optional(),
        gault::parameter<&Model::overconsolidation_ratio>("overconsolidation_ratio", "R", "1",
                                                          "Size of the ellipse over that through the initial "
                                                          "stress (p'_c/p' where isotropic); give this or "
                                                          "preconsolidation_pressure.")
            .at_least(1)
            .optional(),
        gault::parameter<&Model::preconsolidation_pressure>(
            "preconsolidation_pressure", "p'_c", "Pa",
            "Isotropic, at the start; give this or overconsolidation_ratio.")
            .at_least(least_preconsolidation)
            .optional()};

    static constexpr std::array states{
        gault::scalar_state("preconsolidation_pressure", "Pa", "Isotropic: the size of the ellipse.",
                            least_preconsolidation, least_preconsolidation),
        gault::scalar_state("specific_volume", "1", "1 + void ratio.", 2.0, 1.0),
        gault::scalar_state("plastic_strain", "1",
                            "Accumulated deviatoric plastic strain, sum of sqrt(2/3 de:de).", 0.0, 0.0)};
    static constexpr int preconsolidation = gault::state_index(states, "preconsolidation_pressure");
    static constexpr int specific_volume = gault::state_index(states, "specific_volume");
    static constexpr int plastic_strain = gault::state_index(states, "plastic_strain");
    static constexpr bool has_tangent = true;

    void prepare() {
        exactly_one(poisson_ratio, "poisson_ratio", shear_modulus, "shear_modulus");
        exactly_one(critical_state_volume, "critical_state_volume", initial_void_ratio, "initial_void_ratio");
        exactly_one(overconsolidation_ratio, "overconsolidation_ratio", preconsolidation_pressure,
                    "preconsolidation_pressure");
        if (2.0 * swelling_index >= compression_index)
            throw gault::Invalid("swelling_index",
                                 "must be below half of compression_index: dry of critical the clay would "
                                 "soften faster than it swells, and the stress has no unique solution");
        clay = {critical_state_ratio,
                compression_index,
                swelling_index,
                1.0 - swelling_index / compression_index,
                poisson_ratio ? 1.5 * (1.0 - 2.0 * *poisson_ratio) / (1.0 + *poisson_ratio) : 0.0,
                shear_modulus.value_or(0.0)};
        if (poisson_ratio && *poisson_ratio >= largest_poisson_ratio()) {
            char text[200];
            std::snprintf(text, sizeof text,
                          "is %.6g; with these indices it must be below %.6g, or the clay dry of critical "
                          "softens faster than it unloads and the stress has no unique solution",
                          *poisson_ratio, largest_poisson_ratio());
            throw gault::Invalid("poisson_ratio", text);
        }
    }

    void start(gault::Point& p) const {
        const Pack pressure = -trace(p.stress_old) / 3.0;
        p.fail(!(pressure >= least_pressure),
               "modified Cam clay has no stiffness without effective pressure: the initial mean effective "
               "stress must be a compression of 10 Pa or more");
        const Pack scaled = deviator_size(deviator(p.stress_old)) / critical_state_ratio;
        const Pack through = pressure + scaled * scaled / max(pressure, least_pressure);
        Pack size = overconsolidation_ratio.value_or(1.0) * through;
        if (preconsolidation_pressure) {
            size = max(*preconsolidation_pressure, through); // where a person's digits fall short
            p.fail(
                through > Pack(*preconsolidation_pressure * (1.0 + 1e-6)),
                "the initial stress lies outside of the yield surface: raise preconsolidation_pressure, or "
                "choose a less deviatoric initial stress");
        }
        size = max(size, least_preconsolidation);
        Pack volume = 1.0 + initial_void_ratio.value_or(0.0);
        if (critical_state_volume) {
            const Pack critical = 0.5 * size; // p' on the critical state line that this ellipse reaches
            volume = *critical_state_volume - compression_index * log(critical / 1e3) +
                     swelling_index * log(critical / max(pressure, least_pressure));
            p.fail(volume <= 1.0, "the initial specific volume would be below 1, a soil without voids: raise "
                                  "critical_state_volume");
        }
        p.set_state(preconsolidation, size);
        p.set_state(specific_volume, volume);
        p.set_state(plastic_strain, 0.0);
    }

    void update(gault::Point& p) const {
        const SymmetricTensor strain = accepted_strain(p);
        const Pack volume_old = max(p.state_old(specific_volume), 1.0);
        const Step s = step(p.stress_old, strain, p.state_old(preconsolidation), volume_old);
        const Returned r = return_to_surface(clay, s);
        p.retry(r.missed, 0.5);
        p.fail(s.volume < 1.0, "the soil was compressed until no voids were left: the specific volume fell "
                               "below 1, where modified Cam clay ends");

        for (int i = 0; i < 6; ++i)
            p.stress[i] = r.deviator[i] - (i < 3 ? r.pressure : Pack(0.0));
        p.set_state(preconsolidation, r.preconsolidation);
        p.set_state(specific_volume, max(s.volume, 1.0));
        p.set_state(plastic_strain, p.state_old(plastic_strain) + r.plastic_shear);
        set_moduli(p, s, r, volume_old);
        if (p.wants_tangent()) {
            const Tangent t = tangent(clay, s, r);
            for (int row = 0; row < 6; ++row)
                for (int column = 0; column < 6; ++column)
                    p.set_tangent(row, column, t[row][column]);
        }
    }

  private:
    static void exactly_one(const std::optional<double>& first, const char* first_name,
                            const std::optional<double>& second, const char* second_name) {
        if (first.has_value() == second.has_value())
            throw gault::Invalid(first ? second_name : first_name,
                                 std::string("exactly one of ") + first_name + " and " + second_name +
                                     " must be given, not " + (first ? "both" : "none"));
    }

    // See README.md, limit of softening.
    double largest_poisson_ratio() const {
        const double b = swelling_index / (compression_index - swelling_index);
        const double c = 0.5 * (1.0 - std::sqrt(1.0 - b * b));
        const double least = c * critical_state_ratio * critical_state_ratio / 3.0; // of G / K
        return (1.5 - least) / (3.0 + least);
    }

    // Zero where the increment is refused, so that what is returned there stays finite.
    GAULT_INLINE SymmetricTensor accepted_strain(gault::Point& p) const {
        constexpr double largest = 0.3, most_of_log_pressure = 100.0; // exp() of it, squared, is a number
        Pack size = 0.0, sum = trace(p.stress_old);
        for (int i = 0; i < 6; ++i) {
            size = max(size, abs(p.strain[i]));
            sum += p.strain[i] + (i < 3 ? Pack(0.0) : p.stress_old[i]);
        }
        const Mask unknown = !((sum - sum == 0.0) | (size > largest));
        const Pack volume = p.state_old(specific_volume);
        const Mask large =
            (size > largest) | (volume * abs(trace(p.strain)) > Pack(most_of_log_pressure * swelling_index));
        p.fail(unknown, "the strain increment or the old stress is not a finite number");
        p.retry(large, 0.25);
        SymmetricTensor strain;
        for (int i = 0; i < 6; ++i)
            strain[i] = select(unknown | large, 0.0, p.strain[i]);
        return strain;
    }

    // Of the larger pressure of both ends; G that changes with volumetric strain adds its change times the shear, and
    // as much again where plastic flow follows it.
    GAULT_INLINE void set_moduli(gault::Point& p, const Step& s, const Returned& r, Pack volume_old) const {
        const Pack bulk = s.volume * r.pressure / swelling_index;
        const Pack most_bulk = max(bulk, volume_old * s.pressure / swelling_index);
        const Pack shear = clay.shear > 0.0 ? Pack(clay.shear) : clay.shear_per_bulk * bulk;
        const Pack most_shear = clay.shear > 0.0 ? Pack(clay.shear) : clay.shear_per_bulk * most_bulk;
        const Pack change = shear_modulus_slope(clay, s, max(r.x, s.lost / swelling_index),
                                                s.volume / swelling_index, abs(s.mean_volume_slope));
        p.modulus = most_bulk + 4.0 / 3.0 * most_shear + 4.0 * change * sqrt(inner(s.strain, s.strain));
        p.shear_modulus = shear;
    }
};

} // namespace GAULT_ISA
} // namespace modified_cam_clay

GAULT_MODULE("modified_cam_clay", "1.0.0", "The Gault authors", "MIT",
             gault::Material<modified_cam_clay::Model>)
