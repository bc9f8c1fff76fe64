// The perfectly plastic soils behind one interface, as shared libraries: random parameters, and the yield function.
#pragma once
#include "tests/properties/random.hpp"

#include <memory>

namespace properties {

using mohr_coulomb_test::diagonal;
using mohr_coulomb_test::dot;
using mohr_coulomb_test::minus;
using mohr_coulomb_test::norm;
using plugin_test::degree;
using plugin_test::Tensor;

struct Soil {
    mohr_coulomb_test::Parameters p; // Pa, deg
    bool cone;                       // Drucker and Prager's, through the compression edges of the hexagon
    std::unique_ptr<plugin_test::Component> component;

    double excess(const Tensor& s) const { // > 0: outside, Pa
        if (!cone) return p.excess(mohr_coulomb_test::principal(s));
        const double sine = std::sin(p.phi * degree), slope = 6 * sine / (std::sqrt(3.0) * (3 - sine));
        const double mean = (s[0] + s[1] + s[2]) / 3;
        const Tensor deviator = minus(s, diagonal(mean, mean, mean));
        return norm(deviator) / std::sqrt(2.0) + slope * (mean - p.c / std::tan(p.phi * degree));
    }
    double bulk() const { return p.lame() + 2 * p.G() / 3; }
    Tensor elastic(Tensor stress, const Tensor& strain) const {
        const double volumetric = p.lame() * (strain[0] + strain[1] + strain[2]);
        for (int i = 0; i < 6; ++i)
            stress[i] += 2 * p.G() * strain[i] + (i < 3 ? volumetric : 0.0);
        return stress;
    }
    Tensor compliance(Tensor stress) const {
        const double mean = (stress[0] + stress[1] + stress[2]) / 3;
        for (int i = 0; i < 6; ++i)
            stress[i] =
                i < 3 ? (stress[i] - mean) / (2 * p.G()) + mean / (3 * bulk()) : stress[i] / (2 * p.G());
        return stress;
    }
};

// `flows_inward`: the dilation angle may be negative, as far as the plugin allows.
inline Soil random_soil(bool cone, bool flows_inward) {
    Soil soil{{}, cone, nullptr};
    soil.p.E = magnitude(5, 9);
    soil.p.nu = whole(0, 4) == 0 ? uniform(0.49, 0.4999) : uniform(cone ? 0.0 : -0.5, 0.49);
    soil.p.phi = uniform(cone ? 0.5 : 0.0, 70.0);
    soil.p.c = whole(0, 4) == 0 && soil.p.phi > 0.0 ? 0.0 : magnitude(0, 6);
    soil.p.psi = flows_inward && !cone ? uniform(-5.0, soil.p.phi) : soil.p.phi * uniform(0.0, 1.0);
    if (!cone && soil.p.phi > 1.0 && whole(0, 3) == 0) // a cut-off below the apex
        soil.p.t = uniform(0.0, 0.99) * soil.p.c / std::tan(soil.p.phi * degree);
    const char* name = cone ? "drucker_prager" : "mohr_coulomb";
    RC_TAG(std::string(name));
    try {
        soil.component = std::make_unique<plugin_test::Component>(name, GAULT_MATERIAL, name,
                                                                  mohr_coulomb_test::settings(soil.p));
    } catch (const plugin_test::Invalid&) {
        RC_DISCARD("the plugin refuses these parameters");
    }
    RC_LOG() << name << " E " << soil.p.E << " nu " << soil.p.nu << " c " << soil.p.c << " phi " << soil.p.phi
             << " psi " << soil.p.psi << " cut off at " << soil.p.t.value_or(-1.0) << std::endl;
    return soil;
}

struct Increment {
    Tensor stress_old, strain;
};

// New stress and states of every point, in calls of the given lengths.
struct Answer {
    std::vector<Tensor> stress;
    std::vector<double> state;
};
inline Answer update(const Soil& soil, const std::vector<Increment>& points,
                     const std::vector<std::size_t>& lengths = {}) {
    Answer answer;
    std::size_t first = 0;
    const auto call = [&](std::size_t n) {
        plugin_test::Batch batch(*soil.component, static_cast<int64_t>(n));
        for (std::size_t i = 0; i < (n + 7) / 8 * 8; ++i) { // lanes beyond repeat the last point
            const Increment& one = points[first + std::min(i, n - 1)];
            batch.set_strain(static_cast<int64_t>(i), one.strain);
            batch.set_stress_old(static_cast<int64_t>(i), one.stress_old);
        }
        RC_ASSERT(batch.update() == gault_status(GAULT_OK));
        for (std::size_t i = 0; i < n; ++i) {
            answer.stress.push_back(batch.stress_at(static_cast<int64_t>(i)));
            answer.state.push_back(batch.state[0][static_cast<int64_t>(i)]);
        }
        first += n;
    };
    for (const std::size_t n : lengths)
        call(n);
    if (first < points.size()) call(points.size() - first);
    return answer;
}

// Increments from admissible stresses: random stresses, returned.
inline std::vector<Increment> random_increments(const Soil& soil, std::size_t n) {
    mohr_coulomb_test::Random random = many();
    std::vector<Increment> points(n);
    for (Increment& one : points) {
        one.stress_old = random.tensor(random.magnitude(-2, 7));
        for (int k = 0; k < 3; ++k)
            one.stress_old[k] -= random.magnitude(-2, 7);
    }
    const Answer admissible = update(soil, points);
    for (std::size_t i = 0; i < n; ++i)
        points[i] = {admissible.stress[i], random.tensor(random.magnitude(-8, 0))};
    return points;
}

} // namespace properties
