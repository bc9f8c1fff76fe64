// Undrained clay in total stresses: see README.md for equations and signs.
#include <gault/material.hpp>
#include <gault/tensor.hpp>

using gault::Mask;
using gault::max;
using gault::min;
using gault::Pack;
using gault::select;
using gault::SymmetricTensor;

struct Tresca { // s1 - s3 <= 2 su, tension positive
    static constexpr const char *name = "tresca", *version = "1.0.0";
    static constexpr const char* doc = "Clay, loaded fast: elastic, perfectly plastic at the undrained "
                                       "strength, without change of volume by flow.";
    static constexpr const char* reference = "de Souza Neto, E. A., Peric, D. and Owen, D. R. J. (2008), "
                                             "Computational Methods for Plasticity, 8.2";

    double young_modulus, poisson_ratio, undrained_strength;
    using Self = Tresca;
    static constexpr std::array parameters{
        gault::parameter<&Self::young_modulus>("young_modulus", "E", "Pa", "Young's modulus, undrained.")
            .above(0),
        gault::parameter<&Self::poisson_ratio>("poisson_ratio", "nu", "1",
                                               "Poisson's ratio; near 0.5, as water hardly yields.")
            .above(-1)
            .below(0.5)
            .fallback(0.49),
        gault::parameter<&Self::undrained_strength>("undrained_strength", "s_u", "Pa",
                                                    "Undrained strength: the largest shear stress.")
            .above(0)};
    static constexpr std::array states{gault::scalar_state(
        "plastic_shear_strain", "1", "Accumulated, engineering: plastic work / undrained strength.", 0, 0)};
    static constexpr int plastic_shear_strain = gault::state_index(states, "plastic_shear_strain");
    static constexpr bool has_tangent = true;

    double shear, lame; // Pa
    void prepare() {
        shear = young_modulus / (2 * (1 + poisson_ratio));
        lame = 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio);
    }

    void start(gault::Point& p) const {
        const Ordered s = ordered(gault::spectral(p.stress_old).value);
        const Pack slack = 1e-9 * (1 + max(gault::abs(s.s1), gault::abs(s.s3))); // a person's digits
        p.fail(
            s.s1 - s.s3 - 2 * undrained_strength > slack,
            "the initial stress exceeds the undrained strength: its largest and its least principal stress "
            "differ by more than 2 undrained_strength");
    }

    GAULT_INLINE void update(gault::Point& p) const {
        const SymmetricTensor trial = gault::add_elastic(p.stress_old, p.strain, lame, 2 * shear);
        Updated u = update_in_plane(trial);
        const Mask oblique = !((trial[4] == 0.0) & (trial[5] == 0.0));
        if (any(oblique)) { // lane by lane the one or the other: no lane's result depends on its neighbours
            const SymmetricTensor given = trial; // a copy: what a call may see cannot stay in registers
            const Updated v = update_in_space(given);
            for (int i = 0; i < 6; ++i)
                u.stress[i] = select(oblique, v.stress[i], u.stress[i]);
            u.plastic = select(oblique, v.plastic, u.plastic);
        }
        p.stress = u.stress;
        p.set_state(plastic_shear_strain, p.state_old(plastic_shear_strain) + u.plastic);
        p.modulus = lame + 2 * shear;
        p.shear_modulus = shear;
        if (p.wants_tangent()) {
            const SymmetricTensor given = trial;
            write_tangent(given, p);
        }
    }

  private:
    struct Ordered { // principal stresses, s1 >= s2 >= s3
        Pack s1, s2, s3;
    };
    struct Updated {
        SymmetricTensor stress;
        Pack plastic; // increment of the plastic shear strain
    };

    GAULT_INLINE static Ordered ordered(const gault::Triple& s) {
        const auto& [a, b, c] = s;
        return {max(max(a, b), c), max(min(a, b), min(max(a, b), c)), min(min(a, b), c)};
    }
    GAULT_INLINE Mask yields(const Ordered& t) const { return t.s1 - t.s3 > 2 * undrained_strength; }

    // The nearest point of the hexagon, face or edge: see README.md. For trial stresses that yield.
    GAULT_INLINE Ordered returned(const Ordered& t) const {
        const double most = 2 * undrained_strength / 3; // of the deviator's middle value: s1 = s2
        const Pack mean = (t.s1 + t.s2 + t.s3) / 3;
        const Pack centre = mean - 0.5 * max(min(t.s2 - mean, most), -most); // (s1 + s3) / 2
        const Pack s1 = centre + undrained_strength, s3 = centre - undrained_strength;
        return {s1, max(min(t.s2, s1), s3), s3};
    }
    // Of the shear on one face, or on both that meet in an edge.
    GAULT_INLINE Pack plastic_shear(const Ordered& t, const Ordered& s) const {
        return max(max(t.s1 - s.s1, s.s3 - t.s3), 0) / shear;
    }

    // Trial stresses without yz and zx. Principal directions are not needed: see InPlaneSpectral.
    GAULT_INLINE Updated update_in_plane(const SymmetricTensor& trial) const {
        const gault::InPlaneSpectral in_plane = gault::in_plane_spectral(trial);
        const Pack zz = trial[2];
        const Ordered t{max(in_plane.high, zz), max(in_plane.low, min(in_plane.high, zz)),
                        min(in_plane.low, zz)};
        const Mask plastic = yields(t);
        if (!any(plastic)) return {trial, 0};

        const Ordered s = returned(t);
        const Mask zz_first = zz >= in_plane.high, zz_last = zz <= in_plane.low;
        const Pack high = select(zz_first, s.s2, s.s1), low = select(zz_last, s.s2, s.s3);
        const Pack mean = 0.5 * (high + low);
        const Pack scale = 0.5 * (high - low) / max(in_plane.radius, std::numeric_limits<double>::min());
        const Pack half = in_plane.half_difference * scale;
        const SymmetricTensor stress{
            mean + half,      mean - half, select(zz_first, s.s1, select(zz_last, s.s3, s.s2)),
            trial[3] * scale, trial[4],    trial[5]};
        return where(plastic, stress, plastic_shear(t, s), trial);
    }

    __attribute__((noinline)) Updated update_in_space(const SymmetricTensor& trial) const {
        const gault::Spectral spectral = gault::spectral(trial);
        const Ordered t = ordered(spectral.value), s = returned(t);
        gault::Triple value;
        for (int i = 0; i < 3; ++i)
            value[i] = select(spectral.value[i] == t.s1, s.s1, select(spectral.value[i] == t.s3, s.s3, s.s2));
        return where(yields(t), gault::compose(value, spectral.vector), plastic_shear(t, s), trial);
    }

    GAULT_INLINE static Updated where(Mask plastic, const SymmetricTensor& stress, Pack growth,
                                      const SymmetricTensor& trial) {
        Updated u{trial, select(plastic, growth, 0)};
        for (int i = 0; i < 6; ++i)
            u.stress[i] = select(plastic, stress[i], trial[i]);
        return u;
    }

    // The bulk modulus, and 2G weight[k] times the square of six deviatoric tensors n[k]: what is left of the
    // stretch along the principal directions, and of the shear between them, which is the turning of the axes.
    __attribute__((noinline)) void write_tangent(const SymmetricTensor& trial, gault::Point& p) const {
        gault::Spectral spectral = gault::spectral(trial);
        gault::sort_descending(spectral);
        const auto& [t1, t2, t3] = spectral.value;
        const Mask elastic = !yields({t1, t2, t3});
        const Ordered s = returned({t1, t2, t3});
        const Mask edge = (s.s2 == s.s1) | (s.s2 == s.s3);
        const auto kept = [elastic](Pack before, Pack after) { // of a principal difference; 0 / 0 on an edge
            const Pack share = after / max(before, std::numeric_limits<double>::min());
            return select(elastic, 1, max(min(share, 1), 0));
        };
        const Pack along = select(elastic, 1, 0), middle = select(elastic, 1, select(edge, 0, 1.5));
        const Pack weight[6] = {along,
                                middle,
                                along,
                                0.5 * kept(t1 - t2, s.s1 - s.s2),
                                0.5 * kept(t2 - t3, s.s2 - s.s3),
                                0.5 * kept(t1 - t3, s.s1 - s.s3)};

        constexpr int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
        Pack n[6][6]; // [which][component]
        for (int k = 0; k < 6; ++k)
            for (int c = 0; c < 6; ++c) {
                const gault::Triple &a = spectral.vector[row[k]], &b = spectral.vector[column[k]];
                const Pack product = a[row[c]] * b[column[c]];
                n[k][c] = k < 3 ? product - (c < 3 ? 1.0 / 3 : 0.0) : product + a[column[c]] * b[row[c]];
            }
        const double bulk = lame + 2 * shear / 3;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) {
                Pack sum = 0;
                for (int k = 0; k < 6; ++k)
                    sum += weight[k] * n[k][i] * n[k][j];
                p.set_tangent(i, j, (i < 3 && j < 3 ? bulk : 0) + (j < 3 ? 2 : 4) * shear * sum); // xy and yx
            }
    }
};
GAULT_MODULE("tresca", "1.0.0", "The Gault authors", "MIT", gault::Material<Tresca>)
