// Soils that are right, one of every kind that the contract knows, and two that no verdict is possible of.
#include "tests/certificate/base_soils.hpp"

#include <vector>

namespace {

using gault::Components;
using gault::Pack;

struct Plain : Elastic {
    static constexpr const char* name = "plain";
    static constexpr bool has_tangent = true;
    void update(gault::Point& p) const {
        elastic(p);
        if (p.wants_tangent()) p.set_elastic_tangent(lame, shear);
    }
};

struct Sand : Cone {
    static constexpr const char* name = "sand";
};

struct Rubber : Finite {
    static constexpr const char* name = "rubber";
};

// Stiffer along a direction that is kept as a vector, which the host turns.
struct Fabric : Elastic {
    static constexpr const char* name = "fabric";
    static constexpr std::array states{gault::vector_state("bedding", "1", "Its normal.", 0, -1.01, 1.01)};
    void start(gault::Point& p) const { p.set_state(1, 1.0); }
    void update(gault::Point& p) const {
        elastic(p);
        stiffen(p, {p.state_old(0), p.state_old(1), p.state_old(2)});
    }
    void stiffen(gault::Point& p, const gault::Triple& n) const {
        static constexpr int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
        Pack along = 0.0;
        for (int k = 0; k < 6; ++k)
            along += (k < 3 ? 1.0 : 2.0) * n[row[k]] * p.strain[k] * n[column[k]];
        for (int k = 0; k < 6; ++k)
            p.stress[k] += 0.5 * shear * along * n[row[k]] * n[column[k]];
        p.modulus += 0.5 * shear;
    }
};

struct FixedAxis : Fabric { // the same along y, whatever turns
    static constexpr const char* name = "fixed_axis";
    static constexpr std::array<gault_state, 0> states{};
    void start(gault::Point&) const {}
    void update(gault::Point& p) const {
        elastic(p);
        stiffen(p, {0.0, 1.0, 0.0});
    }
};

// Kinematic hardening: |s - back| <= size, back a symmetric state.
struct Kinematic : Elastic {
    static constexpr const char* name = "kinematic";
    static constexpr std::array states{
        gault::symmetric_state("back_stress", "Pa", "Centre of the yield surface, deviatoric.")};
    void update(gault::Point& p) const {
        constexpr double size = 20e3, hardening = 5e6; // Pa
        elastic(p);
        const Components back = p.symmetric_state_old(0);
        const Pack mean = (p.stress[0] + p.stress[1] + p.stress[2]) / 3.0;
        Components from = p.stress, moved = back;
        for (int i = 0; i < 6; ++i)
            from[i] -= back[i] + (i < 3 ? mean : Pack(0.0));
        const Pack length = max(norm(from), 1e-300),
                   growth = max(length - size, 0.0) / (2.0 * shear + hardening);
        for (int i = 0; i < 6; ++i) {
            p.stress[i] -= 2.0 * shear * growth * from[i] / length;
            moved[i] += hardening * growth * from[i] / length;
        }
        p.set_symmetric_state(0, moved);
    }
};

// As many states as a parameter says.
struct Chain : Elastic {
    static constexpr const char* name = "chain";
    int links;
    static constexpr std::array parameters{
        Elastic::parameters[0], Elastic::parameters[1],
        gault::parameter<&Chain::links>("links", "", "1", "Number of states.")
            .at_least(0)
            .at_most(3)
            .fallback(2)};
    std::vector<gault_state> made;
    void prepare() {
        Elastic::prepare();
        static constexpr const char* names[] = {"first", "second", "third"};
        for (int i = 0; i < links; ++i)
            made.push_back(gault::scalar_state(names[i], "1", "Strain so far.", 0, 0));
    }
    const std::vector<gault_state>& instance_states() const { return made; }
    void update(gault::Point& p) const {
        elastic(p);
        for (int i = 0; i < links; ++i)
            p.set_state(i, p.state_old(i) + norm(p.strain));
    }
};

struct Legacy : Elastic { // works in memory that all calls share
    static constexpr const char* name = "legacy";
    static constexpr bool one_at_a_time = true;
    static inline double scratch[4096];
    static gault_status spoil(gault_points& p) {
        for (int64_t i = 0; i < p.count; ++i)
            scratch[i] = p.stress[0][i];
        for (int64_t i = 0; i < p.count; ++i)
            p.stress[0][i] = scratch[i];
        return GAULT_OK;
    }
};

// Mean stress from the volume ratio, stiffness in shear from the density.
struct Dense : Elastic {
    static constexpr const char* name = "dense";
    static constexpr std::array inputs{"density", "volume_ratio"};
    static constexpr std::array states{
        gault::scalar_state("initial_mean", "Pa", "Mean stress at the start.")};
    void start(gault::Point& p) const {
        p.set_state(0, (p.stress_old[0] + p.stress_old[1] + p.stress_old[2]) / 3.0);
    }
    void update(gault::Point& p) const {
        const Pack stiff = shear * p.input(0) / 2000.0, bulk = lame + 2.0 / 3.0 * shear;
        p.stress = gault::add_elastic(p.stress_old, p.strain, -2.0 / 3.0 * stiff, 2.0 * stiff);
        const Pack correction =
            p.state_old(0) + bulk * log(p.input(1)) - (p.stress[0] + p.stress[1] + p.stress[2]) / 3.0;
        for (int i = 0; i < 3; ++i)
            p.stress[i] += correction;
        p.modulus = 1.1 * (bulk / p.input(1) + 4.0 / 3.0 * stiff);
        p.shear_modulus = stiff;
    }
};

struct Sized : Elastic {
    static constexpr const char* name = "sized";
    static constexpr std::array inputs{"characteristic_length"};
    void update(gault::Point& p) const {
        const Pack gain = 1.0 + p.input(0) / 1.0; // a metre
        for (int i = 0; i < 6; ++i)
            p.strain[i] *= gain;
        elastic(p);
        p.modulus *= gain;
        p.shear_modulus *= gain;
    }
};

// A Maxwell body in shear: what it bears fades in a hundred seconds.
struct Salt : Elastic {
    static constexpr const char* name = "salt";
    static constexpr bool rate_dependent = true;
    void update(gault::Point& p) const {
        const double x = p.dt() / 100.0, kept = std::exp(-x), mean_kept = x > 0.0 ? -std::expm1(-x) / x : 1.0;
        Components s = p.stress_old, e = p.strain;
        const Pack mean = (s[0] + s[1] + s[2]) / 3.0, swelling = e[0] + e[1] + e[2];
        elastic(p);
        for (int i = 0; i < 3; ++i)
            s[i] -= mean, e[i] -= swelling / 3.0;
        for (int i = 0; i < 6; ++i)
            p.stress[i] = kept * s[i] + 2.0 * shear * mean_kept * e[i] +
                          (i < 3 ? mean + (lame + 2.0 / 3.0 * shear) * swelling : Pack(0.0));
    }
};

// Stiffness in proportion to the pressure, from no potential: what most soils are between two yield surfaces.
struct Hypoelastic : Elastic {
    static constexpr const char* name = "hypoelastic";
    void update(gault::Point& p) const {
        const Pack pressure = max(-(p.stress_old[0] + p.stress_old[1] + p.stress_old[2]) / 3.0, 1e3);
        const Pack swelling = p.strain[0] + p.strain[1] + p.strain[2], gain = pressure / 100e3;
        const Pack bulk = lame + 2.0 / 3.0 * shear;
        // Exact in the volume: p falls by exp(swelling bulk / 100 kPa).
        const Pack exponent = max(min(-bulk / 100e3 * swelling, 50.0), -50.0),
                   next = pressure * exp(exponent);
        p.retry(abs(exponent) > 0.2, 0.5);
        p.stress = gault::add_elastic(p.stress_old, p.strain, -2.0 / 3.0 * shear * gain, 2.0 * shear * gain);
        const Pack correction = -next - (p.stress[0] + p.stress[1] + p.stress[2]) / 3.0;
        for (int i = 0; i < 3; ++i)
            p.stress[i] += correction;
        p.modulus = max(gain, next / 100e3) * (lame + 2.0 * shear);
        p.shear_modulus = shear * next / 100e3;
    }
};

} // namespace

GAULT_MODULE("right_soils", "1.0.0", "The Gault authors", "MIT", gault::Material<Plain>,
             gault::Material<Sand>, gault::Material<Rubber>, gault::Material<Fabric>,
             gault::Material<FixedAxis>, gault::Material<Kinematic>, gault::Material<Chain>, Spoilt<Legacy>,
             gault::Material<Dense>, gault::Material<Sized>, gault::Material<Salt>,
             gault::Material<Hypoelastic>)
